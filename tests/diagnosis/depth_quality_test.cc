// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_quality.h"

#include <utility>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/support/message_matchers.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

Findings FindingsOn(std::vector<float> depths) {
  DepthQuality image;
  image.valid = 1.0;
  image.sample = std::move(depths);
  Findings findings;
  AddDepthFindings({image}, ByteOrder(), {5000.0, false}, &findings);
  return findings;
}

// Findings on raw depths from 1.5 m on in steps, read with a scale.
Findings FindingsOn(int step, double scale, bool are_floats = false) {
  DepthQuality image;
  image.valid = 1.0;
  for (int i = 0; i < 500; ++i) {
    image.sample.push_back(static_cast<float>((12000 + i * step) / scale));
  }
  Findings findings;
  AddDepthFindings({image}, ByteOrder(), {scale, are_floats}, &findings);
  return findings;
}

TEST(DepthFindings, NameValuesThatWereShiftedByThreeBits) {
  for (const double scale : {1000.0, 5000.0}) {  // the median is unusual with one of them
    ExpectFinding(FindingsOn(8, scale), Severity::kWarning, "depth.scale",
                  Names("SUN3D", "depth_scale", "8000"), "shifted");
  }
}

TEST(DepthFindings, AcceptOtherStepsAndTheRightScale) {
  for (const auto& [step, scale] :
       {std::pair(8, 8000.0), std::pair(16, 5000.0), std::pair(4, 5000.0), std::pair(1, 5000.0)}) {
    ExpectFinding(FindingsOn(step, scale), Severity::kGood, "depth.scale", Names("median"), "good");
  }
  ExpectFinding(FindingsOn(8, 5000.0, true), Severity::kGood, "depth.scale", Names("median"),
                "floats");
}

TEST(DepthFindings, NameAConstantThatIsNoSurface) {
  for (const float constant : {1.5f, 2.0f, 4.0f}) {
    for (const size_t count : {100, 10000}) {
      std::vector<float> depths(count, constant);
      for (int i = 0; i < 1000; ++i) depths.push_back(1.5f + 0.0025f * static_cast<float>(i));
      ExpectFinding(FindingsOn(depths), Severity::kWarning, "depth.constant",
                    Names("raw units", "write 0"), "constant");
    }
  }
  ExpectFinding(FindingsOn(std::vector<float>(1000, 2.0f)), Severity::kWarning, "depth.constant",
                Names("100 %", "2.000 m", "10000"), "nothing else");
}

// A wall across the viewing direction, rounded to disparities.
TEST(DepthFindings, AcceptRoundedSurfaces) {
  std::vector<float> depths(300, 3.992f);
  depths.insert(depths.end(), 100, 3.7f);
  for (int i = 0; i < 600; ++i) depths.push_back(2.0f + 0.002f * static_cast<float>(i));
  for (const Finding& finding : FindingsOn(depths)) EXPECT_NE(finding.check, "depth.constant");
}

}  // namespace
}  // namespace msc_vo
