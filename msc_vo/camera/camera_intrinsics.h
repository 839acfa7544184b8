// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/sensor_correction.h"

namespace msc_vo {

/// Pinhole camera of the undistorted image, and the lens.
struct CameraIntrinsics {
  PinholeCamera camera;
  LensDistortion distortion;
  /// The correction of the given calibration, if it registers depth images to the recorded colour
  /// images; none: they are registered as they are.
  std::optional<SensorCorrection::Vector> registration = {};

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, camera, distortion, registration);
  }
};

/// Returns the intrinsics with the focal length, the principal point, the radial distortion and the
/// registration of depth corrected. If the undistorted image is a chosen part of what the lens
/// sees, it stays the same.
CameraIntrinsics Corrected(const CameraIntrinsics& given,
                           const SensorCorrection::Vector& correction);

/// Whether both register depth images in the same way.
bool HasSameRegistration(const CameraIntrinsics& a, const CameraIntrinsics& b);

/// Returns the pixel of the undistorted image of `to` that shows what `pixel` of that of `from`
/// shows in the same recorded image.
Eigen::Vector2d MovePixel(const CameraIntrinsics& from, const CameraIntrinsics& to,
                          const Eigen::Vector2d& pixel);

}  // namespace msc_vo
