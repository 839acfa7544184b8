// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/line_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

constexpr double kNear = 0.05;        // metres, as for points
constexpr double kMinVisible = 10.0;  // pixels; one pixel of noise rotates this length by 6 degrees
// Fraction of the shorter segment that must overlap with the other one.
constexpr double kMinOverlap = 0.5;
// Weight of a pixel of distance in the matching cost, in bits of descriptor distance. Along one
// edge several fragments pass the gates; descriptor and position select among them together.
constexpr double kBitsPerPixel = 5.0;
constexpr double kNoMatch = std::numeric_limits<double>::infinity();

// An image segment with its precomputed direction and length.
struct MeasuredSegment {
  Eigen::Vector2d start;
  Eigen::Vector2d direction;
  double length;

  explicit MeasuredSegment(const LineSegment2& segment)
      : start(segment.start), direction(segment.Direction()), length(segment.Length()) {}

  // Coordinate of `pixel` along the segment, pixels from its start.
  double Along(const Eigen::Vector2d& pixel) const { return direction.dot(pixel - start); }
  // Distance of `pixel` to the infinite line, pixels.
  double Across(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d d = pixel - start;
    return std::abs(direction.x() * d.y() - direction.y() * d.x());
  }
};

std::vector<MeasuredSegment> MeasureCandidates(const std::vector<LineCandidate>& candidates) {
  std::vector<MeasuredSegment> segments;
  segments.reserve(candidates.size());
  for (const LineCandidate& candidate : candidates) segments.emplace_back(candidate.image);
  return segments;
}

// Distance, pixels, of the candidate's line to the middle of its overlap with the feature; kNoMatch
// if the overlap is too short.
double OverlapDistance(const MeasuredSegment& candidate, const MeasuredSegment& feature,
                       const LineSegment2& image) {
  const double s = feature.Along(image.start);
  const double e = feature.Along(image.end);
  const double first = std::max(0.0, std::min(s, e));
  const double last = std::min(feature.length, std::max(s, e));
  const double shorter = std::min(feature.length, candidate.length);
  if (last - first < kMinOverlap * shorter) return kNoMatch;
  return candidate.Across(feature.start + 0.5 * (first + last) * feature.direction);
}

// Of a line that passes the camera, only the direction across it is compared: its middle may be
// behind, and views along a line differ little in its descriptor.
bool HasSimilarAngle(const Viewpoint& view, const LineLandmark& line) {
  const Eigen::Vector3d ray = line.segment.Midpoint() - view.center;
  if (IsInFront(view.cam_from_world * line.segment)) return Viewpoint::HasSimilarAngle(line, ray);
  const Eigen::Vector3d along = line.segment.Direction();
  const Eigen::Vector3d mean = line.viewing_direction;
  const Eigen::Vector3d ray_across = ray - along.dot(ray) * along;
  const Eigen::Vector3d mean_across = mean - along.dot(mean) * along;
  return mean_across.dot(ray_across) >= kMinViewingCosine * mean_across.norm() * ray_across.norm();
}

}  // namespace

LineCandidate CandidateOf(const LineLandmark& line) {
  LineCandidate candidate;
  candidate.id = line.id;
  candidate.segment = line.segment;
  candidate.descriptor = line.descriptor;
  return candidate;
}

bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      LineCandidate* candidate) {
  LineSegment3 in_cam = cam_from_world * candidate->segment;
  if (!ClipToNear(kNear, &in_cam)) return false;
  candidate->image.start = camera.Project(in_cam.start);
  candidate->image.end = camera.Project(in_cam.end);
  return ClipToImage(camera, &candidate->image) && candidate->image.Length() >= kMinVisible;
}

bool IsVisible(const Viewpoint& view, const LineLandmark& line, LineCandidate* candidate) {
  return HasSimilarAngle(view, line) &&
         ProjectCandidate(view.frame.camera, view.cam_from_world, candidate);
}

std::vector<LineMatch> MatchLines(const LineMatcherOptions& options, const Frame& frame,
                                  const std::vector<LineCandidate>& candidates, double radius,
                                  const std::vector<bool>& taken) {
  struct Claim {
    int candidate = -1;
    double cost = kNoMatch;
  };
  std::vector<Claim> claims(frame.lines.size());
  const double cos_max_angle = std::cos(DegreesToRadians(options.max_angle));
  const std::vector<MeasuredSegment> segments = MeasureCandidates(candidates);
  // Exhaustive search: a few hundred lines on either side, and the first gate is one dot product.
  // Each feature selects its candidate, because a map line may be detected in several fragments.
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& feature = frame.lines[i];
    if (feature.dynamic || (!taken.empty() && taken[i])) continue;
    const MeasuredSegment measured(feature.segment);
    for (size_t j = 0; j < candidates.size(); ++j) {
      if (segments[j].direction.dot(measured.direction) < cos_max_angle) continue;
      const double distance_px = OverlapDistance(segments[j], measured, candidates[j].image);
      if (distance_px > radius) continue;
      const int distance = HammingDistance(candidates[j].descriptor, feature.descriptor);
      if (distance > options.max_distance) continue;
      const double cost = distance + kBitsPerPixel * distance_px;
      if (cost < claims[i].cost) claims[i] = {static_cast<int>(j), cost};
    }
  }
  std::vector<LineMatch> matches;
  for (size_t feature = 0; feature < claims.size(); ++feature) {
    if (claims[feature].candidate < 0) continue;
    const LineCandidate& candidate = candidates[claims[feature].candidate];
    matches.push_back({static_cast<int>(feature), candidate.id, candidate.segment, true});
  }
  return matches;
}

}  // namespace msc_vo
