// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Inverse depth of a line (not in the paper), 2 rows, one per end point of the map line:
///
///   r_S = (1 / z_S - w(s_S)) / sigma_S,   s_S = (pi(T S) - s) . (e - s) / |e - s|^2
///
/// and the same for E. T: cam_from_world (block 0, 7). S, E: end points of the map line in the
/// world, metres (block 1, 6). s, e: end points of the observed segment, pixels. w(s): inverse
/// depth of the measured 3-D line at parameter s of that segment, 1/metres, linear in s
/// (LineDepth::At). sigma_S: its standard deviation there, 1/metres (LineDepth::SigmaAt at the
/// linearisation point).
///
/// The measured line is evaluated where the map's end point projects, so a map line and an
/// observation that cover different parts of the same line agree. Together with LineReprojection
/// the rows constrain the four degrees of freedom of a line and none along it.
class LineDepthReprojection : public CameraFactor<LineDepthReprojection, BlockKind::kLine, 1> {
 public:
  LineDepthReprojection(const PinholeCamera& camera, const LineSegment2& segment,
                        const LineDepth& depth, double sigma_start, double sigma_end)
      : camera_(camera),
        start_(segment.start),
        along_((segment.end - segment.start) / (segment.end - segment.start).squaredNorm()),
        inverse_depth_(depth.start),
        slope_(depth.end - depth.start),
        inverse_sigma_{1.0 / sigma_start, 1.0 / sigma_end} {}

  template <typename T>
  void Residual(int k, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const {
    const Eigen::Matrix<T, 2, 1> p = Project(camera_, x_in_cam);
    const T s = (p.x() - start_.x()) * along_.x() + (p.y() - start_.y()) * along_.y();
    r[0] = (1.0 / x_in_cam.z() - inverse_depth_ - s * slope_) * inverse_sigma_[k];
  }
  Eigen::RowVector3d Jacobian(int k, const Eigen::Vector3d& x_in_cam) const {
    Eigen::RowVector3d j = -slope_ * along_.transpose() * ProjectionJacobian(camera_, x_in_cam);
    j.z() -= 1.0 / (x_in_cam.z() * x_in_cam.z());
    return inverse_sigma_[k] * j;
  }

 private:
  PinholeCamera camera_;
  Eigen::Vector2d start_;                // s, pixels
  Eigen::Vector2d along_;                // (e - s) / |e - s|^2, 1/pixels
  double inverse_depth_;                 // w(0), 1/metres
  double slope_;                         // w(1) - w(0), 1/metres
  std::array<double, 2> inverse_sigma_;  // at S and E, metres
};

}  // namespace msc_vo
