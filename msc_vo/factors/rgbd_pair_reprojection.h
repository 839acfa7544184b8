// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// A plane in a depth image: inverse depth is affine in the image on every plane.
struct InverseDepthPlane {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< of the depth image
  double inverse_depth = 0.0;                          ///< at `pixel`, 1/metres
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();  ///< 1/metres per pixel
};

/// One point in two RGB-D images, for self-calibration (not in the paper), 3 rows:
///
///   r = W (pi(R x_a + w_a t) - p_b,   w_a / z - w_b),   z = (R x_a + w_a t)_z
///
/// (R, t): pose b_from_a (block 0, 7). x_a: ray (z = 1) of the recorded pixel p_a of image a, pi:
/// projection to the recorded image, w_a, w_b: inverse depths at the points of the two depth images
/// that belong to p_a and p_b; all of them depend on the SensorCorrection (block 1). W: square root
/// of the information of the rows (pixels, pixels, 1/metres). A depth image that is not registered
/// is read at the intersection of its surface, a plane, with the viewing ray of the colour camera.
class RgbdPairReprojection
    : public CostFunctor<RgbdPairReprojection, 3, 7, SensorCorrection::kSize> {
 public:
  /// The point in one image.
  struct View {
    /// Recorded pixel at the time stamp of the image, after rolling-shutter compensation.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    /// Recorded pixel, before compensation: where the depth belongs to.
    Eigen::Vector2d recorded_pixel = Eigen::Vector2d::Zero();
    /// Derivative of `pixel` with respect to the readout time, pixels/second.
    Eigen::Vector2d pixel_rate = Eigen::Vector2d::Zero();
    InverseDepthPlane surface;
  };

  RgbdPairReprojection(const CorrectedCamera& camera, const View& a, const View& b,
                       const Eigen::Matrix3d& sqrt_information)
      : camera_(camera), a_(a), b_(b), sqrt_information_(sqrt_information) {}

  template <typename T>
  bool operator()(const T* b_from_a, const T* correction, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(b_from_a);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(b_from_a + 4);
    const Eigen::Matrix<T, 2, 1> x = camera_.Ray<T>(a_.pixel, correction);
    const T w = InverseDepth(a_, correction);
    const Eigen::Matrix<T, 3, 1> ray(x.x(), x.y(), T(1.0));
    const Eigen::Matrix<T, 3, 1> in_b = q * ray + w * t;
    if (!(in_b.z() >= kMinCameraDepth)) return false;
    const Eigen::Matrix<T, 2, 1> projected(in_b.x() / in_b.z(), in_b.y() / in_b.z());
    const Eigen::Matrix<T, 2, 1> pixel = camera_.Pixel<T>(projected, correction);
    Eigen::Map<Eigen::Matrix<T, 3, 1>> r(residuals);
    r << pixel.x() - b_.pixel.x(), pixel.y() - b_.pixel.y(),
        w / in_b.z() - InverseDepth(b_, correction);
    r = (sqrt_information_.template cast<T>() * r).eval();
    return true;
  }

  /// Inverse depth of a view, 1/metres, where the viewing ray meets its surface.
  template <typename T>
  T InverseDepth(const View& view, const T* correction) const {
    Eigen::Matrix<T, 2, 1> at_infinity, parallax;
    camera_.DepthPixel<T>(view.recorded_pixel, correction, &at_infinity, &parallax);
    const InverseDepthPlane& plane = view.surface;
    const T numerator = plane.inverse_depth +
                        plane.gradient.x() * (at_infinity.x() - plane.pixel.x()) +
                        plane.gradient.y() * (at_infinity.y() - plane.pixel.y());
    const T denominator =
        1.0 - (plane.gradient.x() * parallax.x() + plane.gradient.y() * parallax.y());
    return camera_.InverseDepth<T>(view.recorded_pixel, T(numerator / denominator), correction);
  }

 private:
  CorrectedCamera camera_;
  View a_;
  View b_;
  Eigen::Matrix3d sqrt_information_;
};

}  // namespace msc_vo
