// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/factors/cost_functor.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Smallest depth z (metres) at which a camera factor is defined. It keeps 1/z and the image
/// coordinates bounded; for points that are nearer or behind the camera a factor returns false.
constexpr double kMinCameraDepth = 0.01;

/// pi(x): projects a point in camera coordinates (metres) to the image (pixels).
template <typename T>
Eigen::Matrix<T, 2, 1> Project(const PinholeCamera& camera,
                               const Eigen::Matrix<T, 3, 1>& x_in_cam) {
  return {camera.fx * x_in_cam.x() / x_in_cam.z() + camera.cx,
          camera.fy * x_in_cam.y() / x_in_cam.z() + camera.cy};
}

/// d pi(x) / dx, pixels per metre.
inline Eigen::Matrix<double, 2, 3> ProjectionJacobian(const PinholeCamera& camera,
                                                      const Eigen::Vector3d& x_in_cam) {
  const double inverse_z = 1.0 / x_in_cam.z();
  const double u = camera.fx * inverse_z, v = camera.fy * inverse_z;
  Eigen::Matrix<double, 2, 3> j;
  j << u, 0.0, -u * x_in_cam.x() * inverse_z, 0.0, v, -v * x_in_cam.y() * inverse_z;
  return j;
}

/// Base of the factors that depend on a landmark only through the camera coordinates x = T X of its
/// points: one for a point landmark, two for a line (`Landmark`). Parameter blocks: cam_from_world,
/// landmark. The two points of a line are its end points, or those
/// of the part of it that SetPart() selects. The derived factor defines the rows of point k and
/// their analytic derivative,
///
/// \code
///   template <typename T>
///   void Residual(int k, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const;
///   Eigen::Matrix<double, RowsPerPoint, 3> Jacobian(int k, const Vector3d& x_in_cam) const;
/// \endcode
///
/// The chain rule from x to pose and landmark is in camera_linearization.h.
template <typename Factor, BlockKind Landmark, int RowsPerPoint>
struct CameraFactor : WindowFactor<Factor, (Landmark == BlockKind::kLine ? 2 : 1) * RowsPerPoint,
                                   BlockKind::kPose, Landmark> {
  static_assert(Landmark == BlockKind::kPoint || Landmark == BlockKind::kLine);
  static constexpr int kNumPoints = Landmark == BlockKind::kLine ? 2 : 1;
  static constexpr int kRowsPerPoint = RowsPerPoint;

  /// Compares a part of the map line instead of the whole.
  void SetPart(const LinePart& part) {
    static_assert(Landmark == BlockKind::kLine, "only lines have parts");
    weight_ = {{{1.0 - part.start, part.start}, {1.0 - part.end, part.end}}};
  }
  /// Weight of end `i` of the landmark in its point k: dx_k / dX_i.
  double Weight(int k, int i) const { return weight_[k][i]; }
  /// Point k of the landmark, in the world.
  template <typename T>
  Eigen::Matrix<T, 3, 1> PointInWorld(int k, const T* landmark) const {
    using Point = Eigen::Map<const Eigen::Matrix<T, 3, 1>>;
    if (kNumPoints == 1 || weight_[k][k] == 1.0) return Point(landmark + 3 * k);
    Eigen::Matrix<T, 3, 1> x = T(weight_[k][0]) * Point(landmark);
    for (int i = 1; i < kNumPoints; ++i) x += T(weight_[k][i]) * Point(landmark + 3 * i);
    return x;
  }

  template <typename T>
  bool operator()(const T* cam_from_world, const T* landmark, T* residuals) const {
    const Eigen::Map<const Eigen::Quaternion<T>> q(cam_from_world);
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> t(cam_from_world + 4);
    for (int k = 0; k < kNumPoints; ++k) {
      const Eigen::Matrix<T, 3, 1> x_in_cam = q * PointInWorld(k, landmark) + t;
      if (!(x_in_cam.z() >= kMinCameraDepth)) return false;
      static_cast<const Factor*>(this)->Residual(k, x_in_cam, residuals + k * RowsPerPoint);
    }
    return true;
  }

 private:
  static constexpr std::array<std::array<double, kNumPoints>, kNumPoints> Identity() {
    if constexpr (kNumPoints == 1) {
      return {{{1.0}}};
    } else {
      return {{{1.0, 0.0}, {0.0, 1.0}}};
    }
  }
  std::array<std::array<double, kNumPoints>, kNumPoints> weight_ = Identity();
};

}  // namespace msc_vo
