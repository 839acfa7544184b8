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

// The stretch that two segments share, as parameters of the first. Empty if last <= first.
struct Overlap {
  double first = 0.0;
  double last = 0.0;
};

Overlap OverlapOn(const LineSegment2& a, const LineSegment2& b) {
  const double s = a.Parameter(b.start);
  const double e = a.Parameter(b.end);
  return {std::max(0.0, std::min(s, e)), std::min(1.0, std::max(s, e))};
}

std::vector<Eigen::Vector2d> Directions(const std::vector<LineCandidate>& candidates) {
  std::vector<Eigen::Vector2d> directions;
  directions.reserve(candidates.size());
  for (const LineCandidate& candidate : candidates) {
    directions.push_back(candidate.image.Direction());
  }
  return directions;
}

// Cost of taking `feature` for `candidate`, whose directions agree: infinite where a gate says no.
double MatchCost(const LineMatcherOptions& options, const LineCandidate& candidate,
                 const LineFeature& feature, double radius) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const LineSegment2& seen = feature.segment;
  const Overlap overlap = OverlapOn(seen, candidate.image);
  const double shared = (overlap.last - overlap.first) * seen.Length();
  const double shorter = std::min(seen.Length(), candidate.image.Length());
  if (shared < options.min_overlap * shorter) return kNever;
  const Eigen::Vector2d middle = seen.At(0.5 * (overlap.first + overlap.last));
  const double offset = candidate.image.DistanceToLine(middle);
  if (offset > radius) return kNever;
  const int distance = HammingDistance(candidate.descriptor, feature.descriptor);
  if (distance > options.max_distance) return kNever;
  return distance + options.bits_per_pixel * offset;
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
    double cost = std::numeric_limits<double>::infinity();
  };
  std::vector<Claim> claims(frame.lines.size());
  const double cos_max_angle = std::cos(DegreesToRadians(options.max_angle));
  const std::vector<Eigen::Vector2d> directions = Directions(candidates);
  // At most a few hundred on either side, and the first gate is one dot product: no grid needed.
  // A map line may be seen in several pieces, so each feature chooses for itself.
  for (size_t feature = 0; feature < frame.lines.size(); ++feature) {
    if (!taken.empty() && taken[feature]) continue;
    const Eigen::Vector2d direction = frame.lines[feature].segment.Direction();
    for (size_t i = 0; i < candidates.size(); ++i) {
      if (directions[i].dot(direction) < cos_max_angle) continue;
      const double cost = MatchCost(options, candidates[i], frame.lines[feature], radius);
      if (cost < claims[feature].cost) claims[feature] = {static_cast<int>(i), cost};
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
