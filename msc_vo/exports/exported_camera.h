// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"

namespace msc_vo {

/// The camera of recorded images in the words that COLMAP and nerfstudio share: the coordinates of
/// pixel centres end in .5.
struct ExportedCamera {
  std::string model;  ///< PINHOLE, OPENCV, FULL_OPENCV, OPENCV_FISHEYE
  int model_id = 0;   ///< number of the model in COLMAP
  int width = 0, height = 0;
  std::vector<double> parameters;  ///< fx fy cx cy, then the coefficients of the lens
};

ExportedCamera ExportCamera(const CameraIntrinsics& intrinsics);

/// The coordinates in a recorded image of a pixel of the undistorted one.
Eigen::Vector2d ExportPixel(const CameraIntrinsics& intrinsics, const Eigen::Vector2d& pixel);

}  // namespace msc_vo
