// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include <Eigen/Core>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/factors/rgbd_pair_reprojection.h"

namespace msc_vo {

/// A CorrectedCamera at one correction, with analytic derivatives. What all pixels have in common
/// is computed once.
class LinearizedCamera {
 public:
  static constexpr int kColorSize = SensorCorrection::kColorSize;
  static constexpr int kDepthSize = SensorCorrection::kSize - kColorSize;
  using ColorJacobian = Eigen::Matrix<double, 2, kColorSize>;
  using DepthJacobian = Eigen::Matrix<double, 1, kDepthSize>;

  LinearizedCamera(const CorrectedCamera& camera, const SensorCorrection::Vector& correction);

  /// CorrectedCamera::camera().
  const PinholeCamera& given() const { return given_; }

  /// CorrectedCamera::Pixel() and its derivatives with respect to `x` and the colour camera.
  Eigen::Vector2d Pixel(const Eigen::Vector2d& x) const;
  Eigen::Matrix2d PixelByPoint(const Eigen::Vector2d& x) const;
  ColorJacobian PixelByCamera(const Eigen::Vector2d& x) const;

  /// CorrectedCamera::Ray(), and its derivative with respect to the colour camera at the ray `x`.
  Eigen::Vector2d Ray(const Eigen::Vector2d& pixel) const;
  ColorJacobian RayByCamera(const Eigen::Vector2d& x) const;

  /// The part of CorrectedCamera::DepthPixel() at inverse depth 0; parallax(): its change with the
  /// inverse depth.
  Eigen::Vector2d DepthPixelAtInfinity(const Eigen::Vector2d& pixel) const {
    return turn_ * (pixel - given_center_) + depth_center_;
  }
  const Eigen::Vector2d& parallax() const { return parallax_; }

  /// RgbdPairReprojection::InverseDepth(), and its derivative with respect to the depth camera,
  /// unless `jacobian` is null.
  double InverseDepth(const RgbdPairReprojection::View& view, DepthJacobian* jacobian) const;

 private:
  PinholeCamera given_;
  Eigen::Vector2d given_center_;
  Eigen::Vector2d focal_;  // both axes
  Eigen::Vector2d center_;
  LensDistortion lens_;
  std::array<LensDistortion, 2> lens_by_k_;  // k1, k2 larger by 1
  Eigen::Matrix2d turn_;                     // turns and magnifies the depth image
  Eigen::Vector2d depth_center_;
  Eigen::Vector2d parallax_;  // pixels times metres
  double offset_;
  double bowl_;
};

}  // namespace msc_vo
