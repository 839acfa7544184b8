// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/sensor/depth_camera.h"

namespace msc_vo {

class RegistrationTarget;

/// Registers the images of a depth camera to the raw (distorted) images of a colour camera.
///
/// A depth pixel covers its square of the depth image, and thus a small parallelogram of the colour
/// image. The parallelogram and the inverse depth in it follow the plane through the pixel and
/// those of its neighbours that lie on the same surface: inverse depth is affine in the undistorted
/// colour image on every plane, so a plane is registered exactly. Where parallelograms overlap, the
/// nearest surface wins. Colour pixels that no parallelogram covers have no depth, as have those
/// that lie behind a surface on both sides of them, which see the background through a hole of the
/// measurement.
class DepthRegistration {
 public:
  /// All arguments must be valid.
  DepthRegistration(const DepthCamera& depth_camera, const PinholeCamera& color,
                    const LensDistortion& color_distortion);

  /// Returns the depth (CV_32FC1, metres along the optical axis of the colour camera, 0: none) of
  /// the pixels of the colour image. `depth`: CV_32FC1, metres; 0, NaN: no measurement.
  /// Thread-safe. Throws std::invalid_argument if the size or the type of `depth` is wrong.
  cv::Mat Register(const cv::Mat& depth) const;

 private:
  struct Row;
  struct Footprints;

  void ProjectRow(const cv::Mat& depth, int v, Row* row) const;
  void ProjectDistortedRow(const cv::Mat& depth, int v, Row* row) const;
  void DistortRow(Row* row) const;
  void ComputeFootprints(const Row& above, const Row& here, const Row& below,
                         Footprints* footprints) const;
  void Draw(const Row& row, const Footprints& footprints, RegistrationTarget* target) const;

  DepthCamera depth_camera_;
  PinholeCamera color_;
  LensDistortion distortion_;
  // The homogeneous colour pixel of depth pixel p with inverse depth w is matrix_ * p + shift_ * w.
  Eigen::Matrix3f matrix_;
  Eigen::Vector3f shift_;
  // Displacement in the colour image by one depth pixel to the right, and downwards, at infinity.
  Eigen::Vector2f right_;
  Eigen::Vector2f down_;
  float stretch_ = 1.0f;  // largest size of an undistorted colour pixel in the distorted image
  cv::Mat depth_pixels_;  // CV_32FC2, undistorted depth pixels; empty: no distortion
  cv::Mat ideal_;  // CV_32FC2, undistorted position of every colour pixel; empty: no distortion
};

/// Registers one image, see DepthRegistration, which is faster for several.
cv::Mat RegisterDepth(const DepthCamera& depth_camera, const PinholeCamera& color,
                      const LensDistortion& color_distortion, const cv::Mat& depth);

}  // namespace msc_vo
