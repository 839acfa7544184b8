// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/line_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

constexpr double kNear = 0.05;        // metres, see ProjectCandidate of points
constexpr double kMinVisible = 10.0;  // pixels; one pixel of noise then turns it by 6 degrees
constexpr double kNever = std::numeric_limits<double>::infinity();

// An image segment with what every pair needs of it.
struct Ruler {
  Eigen::Vector2d start;
  Eigen::Vector2d direction;
  double length;

  explicit Ruler(const LineSegment2& segment)
      : start(segment.start), direction(segment.Direction()), length(segment.Length()) {}

  // Pixels from the start along the direction.
  double Along(const Eigen::Vector2d& pixel) const { return direction.dot(pixel - start); }
  double Across(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector2d d = pixel - start;
    return std::abs(direction.x() * d.y() - direction.y() * d.x());
  }
};

std::vector<Ruler> RulersOf(const std::vector<LineCandidate>& candidates) {
  std::vector<Ruler> rulers;
  rulers.reserve(candidates.size());
  for (const LineCandidate& candidate : candidates) rulers.emplace_back(candidate.image);
  return rulers;
}

// Pixels between the candidate's line and the middle of the stretch that it shares with the
// feature; infinite if they share too little.
double Offset(const LineMatcherOptions& options, const Ruler& candidate, const Ruler& feature,
              const LineSegment2& image) {
  const double s = feature.Along(image.start);
  const double e = feature.Along(image.end);
  const double first = std::max(0.0, std::min(s, e));
  const double last = std::min(feature.length, std::max(s, e));
  const double shorter = std::min(feature.length, candidate.length);
  if (last - first < options.min_overlap * shorter) return kNever;
  return candidate.Across(feature.start + 0.5 * (first + last) * feature.direction);
}

}  // namespace

bool LineMatcherOptions::IsValid(std::string* error) const {
  if (!(max_angle > 0.0 && max_angle <= 90.0)) {
    *error = "line matcher: max_angle must be in (0, 90] degrees";
  } else if (!(min_overlap > 0.0 && min_overlap <= 1.0)) {
    *error = "line matcher: min_overlap must be in (0, 1]";
  } else if (max_distance < 0 || max_distance > 256) {
    *error = "line matcher: max_distance must be between 0 and 256 bits";
  } else if (!(bits_per_pixel >= 0.0)) {
    *error = "line matcher: bits_per_pixel must not be negative";
  } else {
    return true;
  }
  return false;
}

bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      LineCandidate* candidate) {
  LineSegment3 in_cam = cam_from_world * candidate->segment;
  if (!ClipToNear(kNear, &in_cam)) return false;
  candidate->image.start = camera.Project(in_cam.start);
  candidate->image.end = camera.Project(in_cam.end);
  return ClipToImage(camera, &candidate->image) && candidate->image.Length() >= kMinVisible;
}

std::vector<LineMatch> MatchLines(const LineMatcherOptions& options, const Frame& frame,
                                  const std::vector<LineCandidate>& candidates, double radius,
                                  const std::vector<bool>& taken) {
  struct Claim {
    int candidate = -1;
    double cost = kNever;
  };
  std::vector<Claim> claims(frame.lines.size());
  const double cos_max_angle = std::cos(DegreesToRadians(options.max_angle));
  const std::vector<Ruler> rulers = RulersOf(candidates);
  // At most a few hundred on either side, and the first gate is one dot product: no grid needed.
  // A map line may be seen in several pieces, so each feature chooses for itself.
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& feature = frame.lines[i];
    if (feature.dynamic || (!taken.empty() && taken[i])) continue;
    const Ruler ruler(feature.segment);
    for (size_t j = 0; j < candidates.size(); ++j) {
      if (rulers[j].direction.dot(ruler.direction) < cos_max_angle) continue;
      const double offset = Offset(options, rulers[j], ruler, candidates[j].image);
      if (offset > radius) continue;
      const int distance = HammingDistance(candidates[j].descriptor, feature.descriptor);
      if (distance > options.max_distance) continue;
      const double cost = distance + options.bits_per_pixel * offset;
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
