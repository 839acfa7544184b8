// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Depth images that belong to colour images of another time.
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/diagnosis/recording.h"
#include "tests/support/temporary_folder.h"
#include <gtest/gtest.h>

#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/diagnosis/sequence_check.h"

namespace msc_vo {
namespace {

constexpr int kNumPairs = 20;

class RegistrationDelayTest : public TemporaryFolder {
 protected:
  // Check of a sequence that pairs each colour image with the depth image taken `delay` images
  // before it.
  RgbdDecoder Open(int delay, const Recording& recording) {
    Recording delayed = recording;
    for (int i = 0; i < kNumPairs; ++i) {
      const int source = i - delay + kReach;
      delayed.images[i].depth = recording.images[source].depth;
      delayed.images[i].color = recording.images[i + kReach].color;
    }
    delayed.images.resize(kNumPairs);
    delayed.truth.clear();
    const std::string folder = Path(std::to_string(delay));
    delayed.Write(folder);
    SequenceIndex index = OpenSequence(folder);
    const Calibration calibration = ResolveCalibration({}, "", &index);
    return {index, calibration};
  }
  static Recording Moving() {
    SyntheticSequenceOptions options = SmallRoom();
    options.fps = 7.5;
    return Record(options, kNumPairs + 2 * kReach);
  }

  static constexpr int kReach = 2;
};

bool Warns(const Findings& findings, const std::string& check) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.check == check && finding.severity != Severity::kGood;
  });
}

TEST_F(RegistrationDelayTest, IsFoundInBothDirectionsAndNamedInPlaceOfAShift) {
  const Recording recording = Moving();
  for (const int delay : {-2, 2}) {
    const Findings findings = CheckSequence(Open(delay, recording));
    const Finding finding = ExpectFinding(findings, Severity::kWarning, "registration.delay",
                                          Names("2 images", delay > 0 ? "before" : "after", "pair"),
                                          std::to_string(delay));
    EXPECT_NEAR(finding.value.value_or(0.0), -delay / 7.5, 1e-3);
    EXPECT_FALSE(Warns(findings, "registration.shift"));
  }
  const Findings sound = CheckSequence(Open(0, recording));
  EXPECT_FALSE(Warns(sound, "registration.delay")) << Text(sound);
  EXPECT_FALSE(Warns(sound, "registration.shift")) << Text(sound);
}

TEST_F(RegistrationDelayTest, IsNotMistakenForAShift) {
  Recording recording = Moving();
  for (Recording::Image& image : recording.images) {
    cv::Mat moved = cv::Mat::zeros(image.depth.size(), image.depth.type());
    image.depth.colRange(0, 308).copyTo(moved.colRange(12, 320));
    image.depth = moved;
  }
  const Findings findings = CheckSequence(Open(0, recording));
  EXPECT_TRUE(Warns(findings, "registration.shift")) << Text(findings);
  EXPECT_FALSE(Warns(findings, "registration.delay")) << Text(findings);
}

}  // namespace
}  // namespace msc_vo
