// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/far_lines.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace msc_vo {

namespace {

// Largest distance of a line from the part of its plane that has a depth, cells of DepthRanges. At
// the end of its range, a sensor loses walls before their ends (docs/lab/planes.md).
constexpr int kReach = 4;
// Every sensor measures surfaces nearer than this, metres, except windows and the like, through
// which lines behind the wall are seen.
constexpr double kMinRange = 3.0;
// Half the width of a line in the image, where other segments may be parts of the same line,
// pixels.
constexpr double kHalfWidth = 3.0;

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool AreCrossing(const LineSegment2& a, const LineSegment2& b) {
  const auto separates = [](const LineSegment2& line, const LineSegment2& other) {
    const Eigen::Vector2d direction = line.end - line.start;
    return Cross(direction, other.start - line.start) * Cross(direction, other.end - line.start) <=
           0.0;
  };
  return separates(a, b) && separates(b, a);
}

// The largest inverse depth beyond the range of the sensor, 1/metres: that of the farthest surface
// with a depth.
double InverseRange(const DepthRanges& ranges) {
  double smallest = 1.0 / kMinRange;
  for (const DepthRanges::Cell& cell : ranges.cells) {
    if (cell.HasDepth()) smallest = std::min<double>(smallest, cell.min_inverse_depth);
  }
  return smallest;
}

// The lines of a frame, and the planes beside them.
class FarLines {
 public:
  explicit FarLines(const Frame& frame)
      : frame_(frame), inverse_range_(InverseRange(frame.depth_ranges)) {}

  // The depth of a line by the plane beside it; none if there is no plane, or one on each side.
  std::optional<LineDepth> Measure(size_t line) const {
    const PlaneFeature* const left = PlaneBeside(line, 1.0);
    const PlaneFeature* const right = PlaneBeside(line, -1.0);
    if ((left == nullptr) == (right == nullptr)) return std::nullopt;
    return DepthOn(left != nullptr ? *left : *right, frame_.lines[line]);
  }

 private:
  // The plane beside three points of a line, on the side of its normal times `side`.
  const PlaneFeature* PlaneBeside(size_t line, double side) const {
    const LineSegment2& segment = frame_.lines[line].segment;
    const Eigen::Vector2d direction = segment.Direction();
    const Eigen::Vector2d normal = side * Eigen::Vector2d(-direction.y(), direction.x());
    const PlaneFeature* const plane = FirstPlane(line, segment.Midpoint(), normal);
    const bool is_along_line = plane != nullptr &&
                               FirstPlane(line, segment.At(0.25), normal) == plane &&
                               FirstPlane(line, segment.At(0.75), normal) == plane;
    return is_along_line ? plane : nullptr;
  }

  // The plane at the first pixel with a depth on the way from a point of a line along `direction`;
  // null if another line crosses the way.
  const PlaneFeature* FirstPlane(size_t line, const Eigen::Vector2d& start,
                                 const Eigen::Vector2d& direction) const {
    const double step = 0.5 * DepthRanges::CellSize(frame_.camera).minCoeff();
    for (int i = 1; i <= 2 * kReach; ++i) {
      const Eigen::Vector2d pixel = start + i * step * direction;
      if (!frame_.camera.IsInside(pixel)) return nullptr;
      const DepthRanges::Cell& cell =
          frame_.depth_ranges.cells[DepthRanges::CellOf(frame_.camera, pixel)];
      if (!cell.HasDepth()) continue;
      return IsFree(line, {start + kHalfWidth * direction, pixel}) ? PlaneAt(pixel, cell) : nullptr;
    }
    return nullptr;
  }

  bool IsFree(size_t line, const LineSegment2& way) const {
    for (size_t i = 0; i < frame_.lines.size(); ++i) {
      if (i != line && AreCrossing(frame_.lines[i].segment, way)) return false;
    }
    return true;
  }

  const PlaneFeature* PlaneAt(const Eigen::Vector2d& pixel, const DepthRanges::Cell& cell) const {
    const Eigen::Vector3d ray = frame_.camera.Ray(pixel);
    const auto plane = std::find_if(
        frame_.planes.begin(), frame_.planes.end(), [&](const PlaneFeature& candidate) {
          const double inverse_depth = candidate.inverse_depth.dot(ray);
          return inverse_depth > (1.0 - DepthRanges::kTolerance) * cell.min_inverse_depth &&
                 inverse_depth < (1.0 + DepthRanges::kTolerance) * cell.max_inverse_depth;
        });
    return plane != frame_.planes.end() ? &*plane : nullptr;
  }

  // The depth of a line on a plane, with the errors of both; none if the sensor would have measured
  // it.
  std::optional<LineDepth> DepthOn(const PlaneFeature& plane, const LineFeature& line) const {
    Eigen::Matrix<double, 2, 3> rays;
    rays << frame_.camera.Ray(line.segment.start).transpose(),
        frame_.camera.Ray(line.segment.end).transpose();
    const Eigen::Vector2d inverse_depths = rays * plane.inverse_depth;
    if (inverse_depths.minCoeff() < PlaneFeature::kMinInverseDepth ||
        inverse_depths.maxCoeff() > inverse_range_) {
      return std::nullopt;
    }
    const Eigen::Vector2d gradient(plane.inverse_depth.x() / frame_.camera.fx,
                                   plane.inverse_depth.y() / frame_.camera.fy);
    const double sigma = line.sigma * Cross(line.segment.Direction(), gradient);
    LineDepth depth;
    depth.start = inverse_depths[0];
    depth.end = inverse_depths[1];
    depth.covariance =
        rays * plane.covariance * rays.transpose() + sigma * sigma * Eigen::Matrix2d::Identity();
    depth.inlier_ratio = 1.0;
    return depth;
  }

  const Frame& frame_;
  double inverse_range_;
};

}  // namespace

std::shared_ptr<const Frame> MeasureFarLines(const FrameMatches& matches,
                                             std::shared_ptr<const Frame> frame) {
  if (frame->planes.empty() || frame->depth_ranges.cells.empty()) return frame;
  std::vector<bool> is_in_map(frame->lines.size(), false);
  for (const auto& match : matches.lines) is_in_map[match.feature] = true;
  const FarLines far_lines(*frame);
  std::shared_ptr<Frame> measured;  // a copy, because tracking may still use the frame
  for (size_t i = 0; i < frame->lines.size(); ++i) {
    const LineFeature& line = frame->lines[i];
    if (is_in_map[i] || line.HasDepth() || line.dynamic) continue;
    const std::optional<LineDepth> depth = far_lines.Measure(i);
    if (!depth) continue;
    if (measured == nullptr) measured = std::make_shared<Frame>(*frame);
    measured->lines[i].depth = depth;
  }
  return measured != nullptr ? measured : frame;
}

}  // namespace msc_vo
