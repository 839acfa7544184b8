// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_quality.h"

#include "tests/diagnosis/expected_finding.h"
#include "tests/support/message_matchers.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

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

}  // namespace
}  // namespace msc_vo
