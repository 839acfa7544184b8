// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <functional>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

TEST(NoiseFindings, AreNotTestedBeforeTheFirstEstimate) {
  const Findings findings = NoiseFindings({NoiseScale()});
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].severity, Severity::kGood);
  EXPECT_FALSE(findings[0].value.has_value());
}

TEST(NoiseFindings, LeaveOutScalesThatAreNotEstimated) {
  EXPECT_THAT(NoiseFindings({{0.5, 1.0, 1.0}})[0].text, Names("0.50 to 0.50"));
}

// Of 100 images, some are tracked and some have a weak pose.
Findings MatchingFindings(int num_tracked, int num_weak) {
  MotionTrack track;
  track.num_images = 100;
  track.num_weak = num_weak;
  track.images.resize(num_tracked);
  Findings findings;
  AddFrameMotionFindings(track, 640, &findings);
  return findings;
}

TEST(MatchingFindings, WarnOfFewTrackedImages) {
  EXPECT_TRUE(MatchingFindings(80, 0).empty());
  const Findings lost = MatchingFindings(79, 0);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_THAT(lost[0].text, AllOf(Names("79 of 100"), Not(HasSubstr("weak"))));
  EXPECT_THAT(lost[0].fix, Names("slower"));
}

TEST(MatchingFindings, AskForPlanesOrTextureIfPosesAreWeak) {
  const Findings weak = MatchingFindings(10, 80);
  ASSERT_EQ(weak.size(), 1U);
  EXPECT_THAT(weak[0].text, Names("10 of 100", "80", "weak"));
  EXPECT_THAT(weak[0].fix, AllOf(Names("planes", "texture"), Not(HasSubstr("slower"))));
}

// Images of a box that moves along the rows with `velocity` (pixels/second) at each image. Depth is
// taken `delay` seconds after the colour images, of which the stamps contain `stamped`.
Finding LatencyOfBox(const std::function<double(int)>& velocity, double delay, double stamped) {
  MotionTrack track;
  for (int i = 0; i < 40; ++i) {
    const cv::Rect box(110, 70, 90, 80);
    cv::Mat gray(240, 320, CV_8UC1, cv::Scalar(60)), depth(240, 320, CV_32FC1, cv::Scalar(3));
    gray(box).setTo(180);
    depth(box + cv::Point(static_cast<int>(std::lround(delay * velocity(i))), 0)).setTo(1.5);
    MotionImage image;
    image.timestamp = 0.1 * i;
    image.linked = true;
    image.velocity = {velocity(i), 0.0};
    image.edges = AlignEdges(gray, depth);
    image.depth_delay = stamped;
    track.images.push_back(image);
  }
  Findings findings;
  AddLatencyFindings(track, &findings);
  return findings.at(0);
}

double Sway(int i) { return 120.0 * std::sin(0.2 * i); }

TEST(LatencyFindings, WarnOfADelayThatTheStampsDoNotContain) {
  for (const double delay : {-0.08, 0.08}) {
    const Finding finding = LatencyOfBox(Sway, delay, 0.0);
    EXPECT_EQ(finding.severity, Severity::kWarning) << finding.text;
    EXPECT_NEAR(finding.value.value_or(0.0), delay, 0.02);
  }
}

TEST(LatencyFindings, AcceptADelayThatTheStampsContain) {
  for (const double delay : {-0.08, 0.08}) {
    const Finding finding = LatencyOfBox(Sway, delay, delay);
    EXPECT_EQ(finding.severity, Severity::kGood) << finding.text;
    EXPECT_NEAR(finding.value.value_or(1.0), 0.0, 0.02);
  }
}

// A shift of depth explains the edges as well.
TEST(LatencyFindings, AreNotTestedInUniformMotion) {
  for (const double delay : {-0.05, 0.0, 0.05}) {
    for (const double stamped : {0.0, delay}) {
      const Finding finding = LatencyOfBox([](int) { return 100.0; }, delay, stamped);
      EXPECT_EQ(finding.severity, Severity::kGood) << finding.text;
      EXPECT_FALSE(finding.value.has_value()) << finding.text;
    }
  }
}

TEST(LatencyFindings, AreNotTestedAtRest) {
  EXPECT_FALSE(LatencyOfBox([](int) { return 0.0; }, 0.0, 0.0).value.has_value());
}

}  // namespace
}  // namespace msc_vo
