// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The deep check of the sample sequence in data/room.
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/sequence_check.h"

namespace msc_vo {
namespace {

class RoomSequenceTest : public testing::Test {
 protected:
  static Findings Diagnose(const std::function<void(Calibration*)>& damage) {
    SequenceIndex index = OpenSequence(std::string(MSC_VO_DATA_FOLDER) + "/room");
    Calibration calibration = ResolveCalibration(CameraSettings(), "", &index);
    damage(&calibration);
    SequenceCheckOptions options;
    options.deep = true;
    return CheckSequence(RgbdDecoder(index, calibration), options);
  }
  static Severity SeverityOf(const Findings& findings, const std::string& check) {
    for (const Finding& finding : findings) {
      if (finding.check == check) return finding.severity;
    }
    ADD_FAILURE() << "no finding of " << check;
    return Severity::kGood;
  }
};

TEST_F(RoomSequenceTest, SampleIsSound) {
  for (const Finding& finding : Diagnose([](Calibration*) {})) {
    EXPECT_EQ(finding.severity, Severity::kGood) << finding.check << ": " << Describe(finding);
  }
}

TEST_F(RoomSequenceTest, FindsWrongCalibrationOfTheSample) {
  EXPECT_EQ(SeverityOf(Diagnose([](Calibration* c) { c->camera.fx *= 1.03, c->camera.fy *= 1.03; }),
                       "calibration.focal_length"),
            Severity::kWarning);
  EXPECT_EQ(SeverityOf(Diagnose([](Calibration* c) { c->camera.cx -= 40.0; }),
                       "calibration.principal_point"),
            Severity::kWarning);
}

}  // namespace
}  // namespace msc_vo
