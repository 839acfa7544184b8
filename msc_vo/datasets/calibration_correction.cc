// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration_correction.h"

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

Calibration Corrected(const Calibration& calibration, const SensorCorrection::Vector& correction) {
  const PinholeCamera& given = calibration.Recorded();
  LensDistortion lens = calibration.distortion;
  lens.recorded.reset();
  const CameraIntrinsics recorded = Corrected(CameraIntrinsics{given, lens}, correction);
  Calibration corrected = calibration;
  corrected.distortion.k = recorded.distortion.k;
  corrected.SetRecorded(recorded.camera);
  corrected.SetUndistorted();
  if (recorded.registration) {
    const DepthCamera depth_camera = calibration.depth_camera
                                         ? *calibration.depth_camera
                                         : RegisteredDepthCamera(given, recorded.distortion);
    corrected.depth_camera = Corrected(depth_camera, given, recorded.camera, correction);
  }
  return corrected;
}

}  // namespace msc_vo
