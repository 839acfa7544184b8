// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_findings.h"

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

Findings NoiseFindings(const std::vector<NoiseScale>& scales, Findings findings = {}) {
  MotionTrack track;
  track.noise_scales = scales;
  AddNoiseFindings(track, &findings);
  return findings;
}

TEST(NoiseFindings, AcceptNoiseWithinBounds) {
  const Findings findings = NoiseFindings({{0.5, 9.0, 1.0}, {1.0, 9.0, 2.5}});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].severity, Severity::kGood);
  EXPECT_EQ(findings[0].value, 2.5);
  EXPECT_THAT(findings[0].text, Names("0.50", "2.50"));
}

TEST(NoiseFindings, WarnOfDepthThatContradictsTheImages) {
  const Findings findings = NoiseFindings({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_THAT(findings[0].fix, Names("registration"));
}

TEST(NoiseFindings, LeaveTheWarningToTheFindingThatNamesTheCause) {
  const Findings findings =
      NoiseFindings({{3.0, 1.0, 1.0}}, {Warning("registration", "shifted", "warp the depth")});
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[1].severity, Severity::kGood);
  EXPECT_THAT(findings[1].text, Names("contradicts"));
}

TEST(NoiseFindings, TellNearlyExactDepth) {
  const Findings findings = NoiseFindings({{1.0 / 3.0, 1.0, 0.5}});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].severity, Severity::kGood);
  EXPECT_THAT(findings[0].text, Names("exact"));
}

TEST(NoiseFindings, SayNothingWithoutARun) { EXPECT_TRUE(NoiseFindings({}).empty()); }

}  // namespace
}  // namespace msc_vo
