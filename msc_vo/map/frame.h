// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/depth_ranges.h"

namespace msc_vo {

/// 256-bit binary descriptor (rotated BRIEF for points, LBD for lines).
using Descriptor = std::array<uint8_t, 32>;

/// Number of differing bits, 0..256.
int HammingDistance(const Descriptor& a, const Descriptor& b);

/// Scale between adjacent pyramid levels of point features, as in ORB. A constant rather than an
/// option, because extraction, matching by projection and culling must agree on it.
constexpr double kPyramidScale = 1.2;

/// A point feature p_i of the paper. Pixels are undistorted.
struct PointFeature {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sigma = 1.0;                ///< pixels, standard deviation of each coordinate
  int level = 0;                     ///< pyramid level, 0 is the full image
  bool dynamic = false;              ///< on a dynamic object: must not create a landmark
  double angle = 0.0;                ///< radians, orientation in the image
  double inverse_depth = 0.0;        ///< 1/metres; 0: no depth measured
  double inverse_depth_sigma = 0.0;  ///< 1/metres; > 0 if there is a depth
  Descriptor descriptor{};

  bool HasDepth() const { return inverse_depth > 0.0; }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, pixel, sigma, level, dynamic, angle, inverse_depth, inverse_depth_sigma,
                   descriptor);
  }
};

/// A line feature l_j of the paper. Pixels are undistorted.
struct LineFeature {
  LineSegment2 segment;
  double sigma = 1.0;              ///< pixels, of an end point's distance to the true line
  bool dynamic = false;            ///< as for points
  std::optional<LineDepth> depth;  ///< none: the line stays 2-D
  Descriptor descriptor{};

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, segment, sigma, dynamic, depth, descriptor);
  }
};

/// Feature indices in square cells over the image, for radius searches in time proportional to the
/// result. Points outside the image, where undistortion may move them, belong to the nearest cell.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const PinholeCamera& camera, const std::vector<PointFeature>& points);

  /// Indices of the points within `radius` pixels of `pixel`, ascending.
  std::vector<int> Near(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                        double radius) const;
  /// Calls visit(index) for each of these points without allocating; the order depends on the
  /// features alone.
  template <typename Visit>
  void VisitNear(const std::vector<PointFeature>& points, const Eigen::Vector2d& pixel,
                 double radius, const Visit& visit) const {
    if (begins_.empty()) return;
    const int first = ColumnOf(pixel.x() - radius);
    const int last = ColumnOf(pixel.x() + radius);
    for (int row = RowOf(pixel.y() - radius); row <= RowOf(pixel.y() + radius); ++row) {
      // The cells of a row are contiguous.
      const int end = begins_[row * columns_ + last + 1];
      for (int i = begins_[row * columns_ + first]; i < end; ++i) {
        const int index = indices_[i];
        if ((points[index].pixel - pixel).squaredNorm() <= radius * radius) visit(index);
      }
    }
  }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [columns, rows, begins, indices] = *this;  // all members, or it does not compile
    archive(columns, rows, begins, indices);
  }

 private:
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> begins_;   // offset of each cell in indices_; last: their number
  std::vector<int> indices_;  // cell by cell, ascending within each
};

/// The features of one image. Image data is kept beyond this type for self-calibration only, see
/// RecordedImage.
///
/// A frame is immutable once it is built; poses and associations are stored separately, so that
/// frames can be shared between threads without locks.
struct Frame {
  int64_t id = 0;          ///< position in the sequence, from 0
  double timestamp = 0.0;  ///< seconds
  PinholeCamera camera;    ///< without distortion: features are undistorted already
  /// Lens that the features were recorded through, if undistortion moves them to quite other rows.
  std::optional<LensDistortion> lens = {};
  std::vector<PointFeature> points;
  std::vector<LineFeature> lines;
  FeatureGrid grid;  ///< over `points`
  /// With the calibration that the frame was built with, and without rolling-shutter compensation.
  /// A keyframe has none of dynamic surfaces.
  DepthRanges depth_ranges;
  /// Calibration that the features were undistorted with, whose camera is `camera`; null if it is
  /// unknown.
  std::shared_ptr<const CameraIntrinsics> intrinsics;
  /// Parameters of the rolling-shutter compensation that was applied to the features (see
  /// rolling_shutter.h): the camera's velocity, std::nullopt while it is unknown, and the readout
  /// time, seconds.
  std::optional<CameraVelocity> velocity;
  double readout_time = 0.0;

  /// Position in camera coordinates (metres) of a point that has a depth.
  Eigen::Vector3d PointInCamera(int index) const {
    const PointFeature& point = points[index];
    return camera.BackProject(point.pixel, 1.0 / point.inverse_depth);
  }
  /// Segment in camera coordinates (metres) of a line that has a depth.
  LineSegment3 LineInCamera(int index) const {
    return BackProject(camera, lines[index].segment, *lines[index].depth);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, id, timestamp, camera, lens, points, lines, grid, depth_ranges,
                   intrinsics, velocity, readout_time);
  }
};

}  // namespace msc_vo
