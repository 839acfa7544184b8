// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/line_merging.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Largest angle between the directions of two pieces, radians (5 degrees). The standard deviation
// of the direction of a piece of 20 px is 4 degrees (1 px at each end).
constexpr double kMaxAngle = 0.0873;
// Largest distance of any of the four end points from the common line, pixels: two sigmas of an end
// point.
constexpr double kMaxMergeDistance = 2.0;
// Largest gap between two pieces along the line, pixels: an object that crosses and occludes the
// line, such as a thin bar, or another edge with its blur. Pieces that overlap have no gap.
constexpr double kMaxGap = 15.0;

// A total order: longest first, equal lengths by coordinates.
bool Longer(const LineSegment2& a, const LineSegment2& b) {
  const auto key = [](const LineSegment2& s) {
    return std::make_tuple(-(s.end - s.start).squaredNorm(), s.start.x(), s.start.y(), s.end.x(),
                           s.end.y());
  };
  return key(a) < key(b);
}

// Distance of x from the line through `point`, pixels.
double DistanceToLine(const Vector2d& point, const Vector2d& direction, const Vector2d& x) {
  const Vector2d d = x - point;
  return std::abs(direction.x() * d.y() - direction.y() * d.x());
}

// Least-squares line through all pixels of both segments, as centre and unit direction.
struct CommonLine {
  Vector2d center;
  Vector2d direction;

  CommonLine(const LineSegment2& a, const LineSegment2& b) {
    const double weight_a = a.Length();
    const double weight_b = b.Length();
    center = (weight_a * a.Midpoint() + weight_b * b.Midpoint()) / (weight_a + weight_b);
    // Second moments; that of a uniform segment of length l along itself is l^2 / 12.
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    for (const LineSegment2* segment : {&a, &b}) {
      const Vector2d offset = segment->Midpoint() - center;
      const Vector2d extent = segment->end - segment->start;
      moments +=
          segment->Length() * (offset * offset.transpose() + extent * extent.transpose() / 12.0);
    }
    const double angle = 0.5 * std::atan2(2.0 * moments(0, 1), moments(0, 0) - moments(1, 1));
    direction = Vector2d(std::cos(angle), std::sin(angle));
    if (direction.dot(a.end - a.start) < 0.0) direction = -direction;
  }

  double Along(const Vector2d& x) const { return direction.dot(x - center); }
  double Across(const Vector2d& x) const { return DistanceToLine(center, direction, x); }
};

// The segments behind the i-th one that are parallel to it, up to kMaxAngle.
void FindParallel(const std::vector<Vector2d>& directions, size_t i,
                  std::vector<size_t>* parallel) {
  static const double min_cosine = std::cos(kMaxAngle);
  parallel->resize(directions.size());
  size_t count = 0;
  for (size_t j = i + 1; j < directions.size(); ++j) {  // without branches
    (*parallel)[count] = j;
    count += directions[i].dot(directions[j]) >= min_cosine ? 1 : 0;
  }
  parallel->resize(count);
}

std::optional<LineSegment2> Merge(const LineSegment2& a, const LineSegment2& b) {
  const CommonLine line(a, b);
  for (const Vector2d& x :
       {Vector2d(a.start), Vector2d(a.end), Vector2d(b.start), Vector2d(b.end)}) {
    if (line.Across(x) > kMaxMergeDistance) return std::nullopt;
  }
  const double a0 = line.Along(a.start);
  const double a1 = line.Along(a.end);
  const double b0 = line.Along(b.start);
  const double b1 = line.Along(b.end);
  if (std::max(b0 - a1, a0 - b1) > kMaxGap) return std::nullopt;
  return LineSegment2{line.center + std::min(a0, b0) * line.direction,
                      line.center + std::max(a1, b1) * line.direction};
}

}  // namespace

std::vector<LineSegment2> MergeCollinear(std::vector<LineSegment2> segments) {
  std::sort(segments.begin(), segments.end(), Longer);
  std::vector<Vector2d> directions;
  for (const LineSegment2& segment : segments) directions.push_back(segment.Direction());
  std::vector<size_t> parallel;
  std::vector<char> taken(segments.size(), 0);
  std::vector<LineSegment2> merged;
  for (size_t i = 0; i < segments.size(); ++i) {
    if (taken[i]) continue;
    FindParallel(directions, i, &parallel);
    LineSegment2 line = segments[i];
    Vector2d direction = directions[i];
    for (bool grown = true; grown;) {
      grown = false;
      for (const size_t j : parallel) {
        if (taken[j]) continue;
        // Quick rejection: if all end points are close to the common line, the midpoint is close to
        // this one.
        const double across = DistanceToLine(line.start, direction, segments[j].Midpoint());
        if (across > 3.0 * kMaxMergeDistance) continue;
        const std::optional<LineSegment2> joined = Merge(line, segments[j]);
        if (!joined) continue;
        line = *joined;
        direction = line.Direction();
        taken[j] = 1;
        grown = true;
      }
    }
    merged.push_back(line);
  }
  std::sort(merged.begin(), merged.end(), Longer);
  return merged;
}

}  // namespace msc_vo
