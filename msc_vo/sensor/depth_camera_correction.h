// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/sensor/depth_camera.h"

namespace msc_vo {

/// Returns the camera of depth images that are registered to the recorded colour images: the camera
/// of these and their lens.
DepthCamera RegisteredDepthCamera(const PinholeCamera& recorded, const LensDistortion& lens);

/// Returns the depth camera with its registration corrected. `given`, `corrected`: camera of the
/// recorded colour images before and after the correction.
DepthCamera Corrected(const DepthCamera& depth_camera, const PinholeCamera& given,
                      const PinholeCamera& corrected, const SensorCorrection::Vector& correction);

/// Returns the camera of depth images that were said to be registered to colour images with the
/// `given` intrinsics, if the `corrected` ones are right.
DepthCamera DepthCameraOf(const CameraIntrinsics& given, const CameraIntrinsics& corrected);

}  // namespace msc_vo
