// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// 256-bit binary descriptor (turned BRIEF for points, LBD for lines).
using Descriptor = std::array<uint8_t, 32>;

// Number of differing bits, 0..256.
int HammingDistance(const Descriptor& a, const Descriptor& b);

// Scale between neighbouring pyramid levels of point features, as ORB has it. A constant and no
// option: extraction, matching by projection and culling must agree on it.
constexpr double kPyramidScale = 1.2;

// A point feature p_i of the paper. Pixels are undistorted.
struct PointFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma = 1.0;                // pixels, standard deviation of each coordinate
  int level = 0;                     // pyramid level, 0 is the full image
  bool dynamic = false;              // by itself, as tracking found: shows no landmark
  double angle = 0.0;                // radians, orientation in the image
  double inverse_depth = 0.0;        // 1/metres; 0: no depth here
  double inverse_depth_sigma = 0.0;  // 1/metres; > 0 if there is a depth
  Descriptor descriptor{};

  bool HasDepth() const { return inverse_depth > 0.0; }
};

// A line feature l_j of the paper. Pixels are undistorted.
struct LineFeature {
  LineSegment2 segment;
  double sigma = 1.0;              // pixels, of an end point's distance to the true line
  bool dynamic = false;            // as of points
  std::optional<LineDepth> depth;  // none: the line stays 2-D
  Descriptor descriptor{};
};

// Buckets of feature indices over the image, for searches by radius in time proportional to the
// answer. Points outside the image (undistortion moves some there) go to the nearest bucket.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const PinholeCamera& camera, const std::vector<PointFeature>& points);

  // Indices of the points within `radius` pixels of `pixel`, ascending.
  std::vector<int> Near(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                        double radius) const;
  // Calls visit(index) for each of them, in an order that depends on nothing else; makes no list.
  template <typename Visit>
  void VisitNear(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                 double radius, const Visit& visit) const {
    if (begins_.empty()) return;
    const int first = ColumnOf(pixel.x() - radius);
    const int last = ColumnOf(pixel.x() + radius);
    for (int row = RowOf(pixel.y() - radius); row <= RowOf(pixel.y() + radius); ++row) {
      // The buckets of a row follow each other.
      const int end = begins_[row * columns_ + last + 1];
      for (int i = begins_[row * columns_ + first]; i < end; ++i) {
        const int index = indices_[i];
        if ((points[index].pixel - pixel).squaredNorm() <= radius * radius) visit(index);
      }
    }
  }

 private:
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> begins_;   // of each bucket among indices_, and their number
  std::vector<int> indices_;  // bucket by bucket, ascending in each
};

// What is kept of an image: its features and nothing else. Images end here.
//
// A frame does not change after it was made; poses and associations live beside it, so that frames
// can be shared between threads without locks.
struct Frame {
  int64_t id = 0;          // position in the sequence, from 0
  double timestamp = 0.0;  // seconds
  PinholeCamera camera;    // without distortion: features are undistorted already
  std::vector<PointFeature> points;
  std::vector<LineFeature> lines;
  FeatureGrid grid;  // over `points`
  // What features were unrolled with, see rolling_shutter.h: the camera's velocity, none while it
  // is not known, and the readout time, seconds.
  std::optional<CameraVelocity> velocity;
  double readout_time = 0.0;

  // Position in camera coordinates (metres) of a point that has a depth.
  Eigen::Vector3d PointInCamera(int index) const {
    const PointFeature& point = points[index];
    return camera.BackProject(point.pixel, 1.0 / point.inverse_depth);
  }
  // Segment in camera coordinates (metres) of a line that has a depth.
  LineSegment3 LineInCamera(int index) const {
    return BackProject(camera, lines[index].segment, *lines[index].depth);
  }
};

}  // namespace msc_vo
