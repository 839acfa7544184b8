// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Warps a depth image to the time of its colour image. `depth` (CV_32FC1, metres, 0: none) was
/// taken at a different time; `motion` transforms points from the camera frame at the time of the
/// colour image to that at the time of the depth image.
///
/// Most RGB-D cameras take their two images one after the other: in fast motion the images are
/// several pixels apart, and pixels beside a depth edge have the depth of the wrong surface. Pixels
/// are those of the raw image, because the effect of lens distortion on a shift of a few pixels is
/// negligible. Returns `depth` itself if points at one metre move by less than half a pixel.
cv::Mat AlignDepth(const PinholeCamera& camera, const cv::Mat& depth, const Rigid3& motion);

/// AlignDepth() for the images of one camera. With a cropped lens (LensDistortion::IsCropped),
/// pixels are undistorted, moved and distorted again, because a wide lens changes shifts by a
/// multiple. Pixels that the undistorted image does not show then have no depth.
class DepthAligner {
 public:
  /// `camera`: intrinsics of the undistorted image.
  DepthAligner(const PinholeCamera& camera, const LensDistortion& distortion);

  cv::Mat Align(const cv::Mat& depth, const Rigid3& motion) const;

 private:
  PinholeCamera camera_;
  LensDistortion distortion_;
  cv::Mat undistorted_;  // CV_32FC2, of every pixel; empty: the lens is not cropped
};

}  // namespace msc_vo
