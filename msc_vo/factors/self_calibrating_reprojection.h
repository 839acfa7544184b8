// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/factors/cost_functor.h"

namespace msc_vo {

/// Reprojection of a map point into the recorded image, for self-calibrating bundle adjustment (not
/// in the paper), 3 rows:
///
///   r = ((pi(T X) - p) / sigma,   (1 / z - w) / sigma_w),   z = (T X)_z
///
/// T: cam_from_world (block 0, 7). X: map point in the world, metres (block 1, 3). pi: projection
/// to the recorded image, which depends on the first SensorCorrection::kColorSize parameters of the
/// correction (block 2). p: recorded pixel. w: measured inverse depth; the last row is zero where
/// there is none.
class SelfCalibratingReprojection
    : public CostFunctor<SelfCalibratingReprojection, 3, 7, 3, SensorCorrection::kColorSize> {
 public:
  struct Measurement {
    /// Recorded pixel at the time stamp of the image, after rolling-shutter compensation.
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sigma = 1.0;                ///< of each coordinate, pixels
    double inverse_depth = 0.0;        ///< 1/metres; 0: not measured
    double inverse_depth_sigma = 0.0;  ///< 1/metres; > 0 if it is measured
  };

  SelfCalibratingReprojection(const CorrectedCamera& camera, const Measurement& measurement)
      : camera_(camera), measurement_(measurement) {}

  template <typename T>
  bool operator()(const T* cam_from_world, const T* point, const T* correction,
                  T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(cam_from_world + 4), x_in_world(point);
    const Eigen::Matrix<T, 3, 1> x = q * x_in_world + t;
    if (!(x.z() >= kMinCameraDepth)) return false;
    const Eigen::Matrix<T, 2, 1> pixel =
        camera_.Pixel<T>(Eigen::Matrix<T, 2, 1>(x.x() / x.z(), x.y() / x.z()), correction);
    residuals[0] = (pixel.x() - measurement_.pixel.x()) / measurement_.sigma;
    residuals[1] = (pixel.y() - measurement_.pixel.y()) / measurement_.sigma;
    residuals[2] = measurement_.inverse_depth > 0.0 ? (1.0 / x.z() - measurement_.inverse_depth) /
                                                          measurement_.inverse_depth_sigma
                                                    : T(0.0);
    return true;
  }

 private:
  CorrectedCamera camera_;
  Measurement measurement_;
};

}  // namespace msc_vo
