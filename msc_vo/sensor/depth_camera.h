// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// A depth camera beside the colour camera, for depth images that are not registered to the colour
/// images.
struct DepthCamera {
  PinholeCamera camera;     ///< intrinsics and size of the depth images
  Rigid3 depth_from_color;  ///< colour camera frame to depth camera frame, metres
  /// Added to every measured inverse depth, 1/metres: corrects a constant error of the disparity.
  double inverse_depth_offset = 0.0;
  LensDistortion distortion = {};  ///< of the depth images

  /// Rotation of the depth images relative to the colour images, radians.
  double Roll() const;

  /// If the depth camera is invalid, `error` names the value and its valid range.
  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
