// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration_correction.h"

#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

Calibration Corrected(const Calibration& calibration, const SensorCorrection::Vector& correction) {
  CameraIntrinsics recorded{calibration.Recorded(), calibration.distortion};
  recorded.distortion.recorded.reset();
  Calibration corrected = Corrected(calibration, Corrected(recorded, correction));
  corrected.SetUndistorted();
  return corrected;
}

Calibration Corrected(const Calibration& calibration, const CameraIntrinsics& intrinsics) {
  Calibration corrected = calibration;
  corrected.camera = intrinsics.camera;
  corrected.distortion = intrinsics.distortion;
  if (intrinsics.registration) {
    const PinholeCamera& given = calibration.Recorded();
    const DepthCamera depth_camera = calibration.depth_camera
                                         ? *calibration.depth_camera
                                         : RegisteredDepthCamera(given, intrinsics.distortion);
    corrected.depth_camera =
        Corrected(depth_camera, given, corrected.Recorded(), *intrinsics.registration);
  }
  return corrected;
}

}  // namespace msc_vo
