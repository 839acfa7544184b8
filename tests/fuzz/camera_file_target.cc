// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// camera.txt: intrinsics, distortion, readout time and depth camera.

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/camera_file.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("camera.txt", AsText(data, size));
  Calibration calibration;
  if (!Accepts(path, [&] { calibration = ReadCameraFile(path); })) return 0;
  std::string error;
  Require(calibration.IsValid(&error), "a calibration that is read is valid: " + error);
  const std::string copy = folder.Write("copy.txt", FormatCameraFile(calibration, "copy"));
  const Calibration again = ReadCameraFile(copy);
  Require(again.camera.fx == calibration.camera.fx &&
              again.distortion.k == calibration.distortion.k &&
              again.readout_time == calibration.readout_time &&
              again.depth_camera.has_value() == calibration.depth_camera.has_value(),
          "what is written is read back");
  return 0;
}
