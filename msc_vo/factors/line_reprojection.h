// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>

#include "msc_vo/factors/camera_factor.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Line reprojection (paper Eq. errorreprline), 2 rows, one per end point of the map line:
///
///   r = ((n . pi(T S) + c) / sigma_S, (n . pi(T E) + c) / sigma_E)
///
/// T: cam_from_world (block 0, 7). S, E: end points of the map line in the world, metres (block 1,
/// 6). (n, c): observed image line with |n| = 1, so that a row is a signed distance in pixels.
/// sigma_S, sigma_E: standard deviation of the observed line where the end point projects, pixels
/// (ImageLineSigma); it grows where the map line extends beyond the observed segment.
///
/// Distances are to the infinite image line because detected end points are not repeatable along a
/// line.
class LineReprojection : public CameraFactor<LineReprojection, BlockKind::kLine, 1> {
 public:
  LineReprojection(const PinholeCamera& camera, const LineSegment2& segment, double sigma_start,
                   double sigma_end)
      : camera_(camera),
        image_line_(ImageLine(segment)),
        inverse_sigma_{1.0 / sigma_start, 1.0 / sigma_end} {}

  template <typename T>
  void Residual(int k, const Eigen::Matrix<T, 3, 1>& x_in_cam, T* r) const {
    const Eigen::Matrix<T, 2, 1> p = Project(camera_, x_in_cam);
    r[0] =
        (image_line_.x() * p.x() + image_line_.y() * p.y() + image_line_.z()) * inverse_sigma_[k];
  }
  Eigen::RowVector3d Jacobian(int k, const Eigen::Vector3d& x_in_cam) const {
    return inverse_sigma_[k] * image_line_.head<2>().transpose() *
           ProjectionJacobian(camera_, x_in_cam);
  }

 private:
  PinholeCamera camera_;
  Eigen::Vector3d image_line_;           // (n, c), pixels
  std::array<double, 2> inverse_sigma_;  // at S and E, 1/pixels
};

}  // namespace msc_vo
