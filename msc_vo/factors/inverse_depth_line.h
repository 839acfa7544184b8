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

// A line of one frame whose end points stay on their viewing rays b_S, b_E (z = 1), with the block
//
//   (w_S, w_E, a, c)
//
// w_S, w_E: inverse depths, 1/metres. a, c: unit normal deviates that say how the line as it was
// meant to be built lies to the line as it is seen: turned by a in the interpretation plane and by
// c out of it. The direction of the former, which structure is about, is that of
//
//   u = b_E w_S - b_S w_E + |u_0| (sigma_a a p_0 + sigma_c c n_0)
//
// as E - S = b_E / w_E - b_S / w_S is parallel to its first part: linear in the block, no division.
// n_0: normal of the interpretation plane. p_0: across the line in that plane. sigma_a: deviation
// of a built line from its ideal. sigma_c: the same and the angle by which image noise tilts the
// interpretation plane. These two errors are common to all pairs of a line; as variables, however
// many partners agree, they do not average out.
class InverseDepthLine {
 public:
  static constexpr int kBlockSize = 4;

  // image_sigma: pixels, of an end point's distance to the true image line. deviation: sigma_a,
  // radians.
  InverseDepthLine(const PinholeCamera& camera, const LineSegment2& segment, const LineDepth& depth,
                   double image_sigma, double deviation)
      : ray_start_(camera.Ray(segment.start)), ray_end_(camera.Ray(segment.end)) {
    const Eigen::Vector3d u = depth.start * ray_end_ - depth.end * ray_start_;
    const Eigen::Vector3d normal = ray_start_.cross(ray_end_).normalized();
    // A pixel across the segment, as a shift of its viewing ray out of the interpretation plane.
    const Eigen::Vector2d d = segment.Direction();
    const double pixel = std::abs(normal.x() * -d.y() / camera.fx + normal.y() * d.x() / camera.fy);
    image_angle_ = image_sigma * pixel * std::hypot(depth.start, depth.end) / u.norm();
    in_plane_ = deviation * normal.cross(u);
    out_of_plane_ = std::hypot(deviation, image_angle_) * u.norm() * normal;
  }

  // Standard deviation of the tilt of the interpretation plane by image noise, radians.
  double image_angle() const { return image_angle_; }

  // False if the line points at the camera and has no length across its rays.
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
