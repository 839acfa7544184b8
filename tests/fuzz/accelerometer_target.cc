// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// accelerometer.txt, and the names of its axes.

#include <cmath>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/accelerometer.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("accelerometer.txt", AsText(data, size));
  SequenceIndex index;
  index.directory = folder.path();
  index.entries = {{1305031102.1, "a", "b", ""}, {1305031103.1, "c", "d", ""}};
  std::vector<TimedAcceleration> readings;
  if (Accepts(path, [&] { readings = ReadAccelerometer(index); })) {
    for (size_t i = 0; i < readings.size(); ++i) {
      Require(std::isfinite(readings[i].timestamp) && readings[i].acceleration.allFinite(),
              "finite readings");
      Require(i == 0 || readings[i].timestamp >= readings[i - 1].timestamp, "readings in order");
    }
  }
  try {
    const std::string text(AsText(data, size));
    const Eigen::Matrix3d rotation = RotationFromAxes(text.substr(0, text.find('\n')));
    Require((rotation * rotation.transpose()).isIdentity(1e-12), "a rotation");
  } catch (const std::invalid_argument&) {
    return 0;
  }
  ++num_accepted;
  return 0;
}
