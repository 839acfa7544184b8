// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Line of one frame in inverse depth along the viewing rays b_S, b_E (z = 1) of its end points.
/// Parameter block:
///
///   (w_S, w_E, a, c)
///
/// w_S, w_E: inverse depths of the end points, 1/metres. a, c: rotation from the observed line to
/// its ideal direction, in the interpretation plane (a) and out of it (c), in standard deviations.
/// The ideal direction, which structural factors constrain, is that of
///
///   u = b_E w_S - b_S w_E + |u_0| (sigma_a a p_0 + sigma_c c n_0).
///
/// E - S = b_E / w_E - b_S / w_S is parallel to the first two terms, so u is linear in the block.
/// n_0: unit normal of the interpretation plane. p_0: unit vector across the line in that plane.
/// sigma_a: angular tolerance of construction. sigma_c: root of the sum of squares of sigma_a and
/// the tilt of the interpretation plane by image noise.
///
/// Both errors are shared by all pairs of a line. As variables of the line, they do not average out
/// over its partners.
class InverseDepthLine {
 public:
  static constexpr int kBlockSize = 4;

  /// `image_sigma`: pixels, standard deviation of an end point's distance to the true image line.
  /// `deviation`: sigma_a, radians.
  InverseDepthLine(const PinholeCamera& camera, const LineSegment2& segment, const LineDepth& depth,
                   double image_sigma, double deviation)
      : ray_start_(camera.Ray(segment.start)), ray_end_(camera.Ray(segment.end)) {
    const Eigen::Vector3d u = depth.start * ray_end_ - depth.end * ray_start_;
    const Eigen::Vector3d normal = ray_start_.cross(ray_end_).normalized();
    // Shift of the viewing ray out of the interpretation plane per pixel across the segment.
    const Eigen::Vector2d d = segment.Direction();
    const double pixel = std::abs(normal.x() * -d.y() / camera.fx + normal.y() * d.x() / camera.fy);
    image_angle_ = image_sigma * pixel * std::hypot(depth.start, depth.end) / u.norm();
    in_plane_ = deviation * normal.cross(u);
    out_of_plane_ = std::hypot(deviation, image_angle_) * u.norm() * normal;
  }

  /// Standard deviation of the tilt of the interpretation plane by image noise, radians.
  double image_angle() const { return image_angle_; }

  /// Unit direction u / |u| in camera axes. Returns false where u is zero: the line points at the
  /// camera.
  template <typename T>
  bool Direction(const T* block, Eigen::Matrix<T, 3, 1>* direction) const {
    using std::sqrt;
    for (int i = 0; i < 3; ++i) {
      (*direction)[i] = ray_end_[i] * block[0] - ray_start_[i] * block[1] +
                        in_plane_[i] * block[2] + out_of_plane_[i] * block[3];
    }
    const T squared = direction->squaredNorm();
    if (!(squared > 0.0)) return false;
    *direction /= sqrt(squared);
    return true;
  }

 private:
  Eigen::Vector3d ray_start_, ray_end_;      // b_S, b_E
  Eigen::Vector3d in_plane_, out_of_plane_;  // |u_0| sigma_a p_0, |u_0| sigma_c n_0
  double image_angle_;
};

}  // namespace msc_vo
