// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/point_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace msc_vo {

namespace {

constexpr int kNoDistance = 257;  // more than the 256 bits of a descriptor
// Largest difference from the predicted pyramid level, in steps of kPyramidScale: the prediction is
// rounded, and a corner may be detected on either side.
constexpr int kMaxLevelDifference = 1;

// The size of a pixel of a pyramid level, in pixels of the image. The table covers all levels of an
// extractor, up to 32, and those of images of 340 times the size.
double PixelSize(int level) {
  constexpr int kMaxLevel = 32;
  static const std::array<double, 2 * kMaxLevel + 1> sizes = [] {
    std::array<double, 2 * kMaxLevel + 1> powers;
    for (int i = -kMaxLevel; i <= kMaxLevel; ++i) {
      powers[i + kMaxLevel] = std::pow(kPyramidScale, i);
    }
    return powers;
  }();
  return sizes[std::clamp(level, -kMaxLevel, kMaxLevel) + kMaxLevel];
}

struct Best {
  int feature = -1;
  int distance = kNoDistance;

  // Ties are broken by the feature index.
  bool operator<(const Best& other) const {
    return std::tie(distance, feature) < std::tie(other.distance, other.feature);
  }
};

// Best feature for one candidate; feature -1 if there is none.
Best FindBest(const PointMatcherOptions& options, const Frame& frame,
              const PointCandidate& candidate, double radius, const std::vector<bool>& taken) {
  Best best;
  Best second;
  const double scaled_radius = radius * PixelSize(candidate.level);
  frame.grid.VisitNear(frame.points, candidate.pixel, scaled_radius, [&](int index) {
    const PointFeature& feature = frame.points[index];
    if (std::abs(feature.level - candidate.level) > kMaxLevelDifference) return;
    if (feature.dynamic || (!taken.empty() && taken[index])) return;
    const Best found{index, HammingDistance(candidate.descriptor, feature.descriptor)};
    if (found < best) {
      second = best;
      best = found;
    } else if (found < second) {
      second = found;
    }
  });
  if (best.distance > options.max_distance) return {};
  const bool ambiguous = second.feature >= 0 &&
                         frame.points[second.feature].level == frame.points[best.feature].level &&
                         best.distance > options.max_ratio * second.distance;
  return ambiguous ? Best() : best;
}

}  // namespace

PointCandidate CandidateOf(const PointLandmark& point) {
  PointCandidate candidate;
  candidate.id = point.id;
  candidate.position = point.position;
  candidate.descriptor = point.descriptor;
  return candidate;
}

void SetLevel(const Viewpoint& view, const PointLandmark& point, PointCandidate* candidate) {
  const double level = point.PredictLevel((point.position - view.center).norm());
  const int highest = view.highest_level + 2;  // too high for any feature to match
  candidate->level =
      static_cast<int>(std::lround(std::clamp<double>(level, view.lowest_level, highest)));
}

bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      PointCandidate* candidate) {
  // Metres: below the range of RGB-D sensors, where the projection becomes unstable.
  constexpr double kNear = 0.05;
  const Eigen::Vector3d in_cam = cam_from_world * candidate->position;
  if (in_cam.z() < kNear) return false;
  candidate->pixel = camera.Project(in_cam);
  return camera.IsInside(candidate->pixel);
}

bool IsVisible(const Viewpoint& view, const PointLandmark& point, PointCandidate* candidate) {
  const Eigen::Vector3d ray = point.position - view.center;
  if (!Viewpoint::HasSimilarAngle(point, ray)) return false;
  const double level = point.PredictLevel(ray.norm());
  // One level of tolerance on both sides, as in the matcher.
  if (!(level > view.lowest_level - 1.5 && level < view.highest_level + 1.5)) return false;
  candidate->level =
      std::clamp(static_cast<int>(std::lround(level)), view.lowest_level, view.highest_level);
  return ProjectCandidate(view.frame.camera, view.cam_from_world, candidate);
}

std::vector<PointMatch> MatchPoints(const PointMatcherOptions& options, const Frame& frame,
                                    const std::vector<PointCandidate>& candidates, double radius,
                                    const std::vector<bool>& taken) {
  struct Claim {
    int candidate = -1;
    int distance = kNoDistance;
  };
  std::vector<Claim> claims(frame.points.size());
  for (size_t i = 0; i < candidates.size(); ++i) {
    const Best best = FindBest(options, frame, candidates[i], radius, taken);
    if (best.feature < 0 || best.distance >= claims[best.feature].distance) continue;
    claims[best.feature] = {static_cast<int>(i), best.distance};
  }
  std::vector<PointMatch> matches;
  for (size_t feature = 0; feature < claims.size(); ++feature) {
    if (claims[feature].candidate < 0) continue;
    const PointCandidate& candidate = candidates[claims[feature].candidate];
    matches.push_back({static_cast<int>(feature), candidate.id, candidate.position, true});
  }
  return matches;
}

std::vector<PointMatch> MatchFrames(const Frame& from, const Rigid3& from_cam_from_world,
                                    const Frame& to, const Rigid3& to_cam_from_world,
                                    double radius) {
  const Rigid3 world_from_cam = from_cam_from_world.Inverse();
  std::vector<PointCandidate> candidates;
  for (size_t i = 0; i < from.points.size(); ++i) {
    const PointFeature& point = from.points[i];
    if (point.dynamic || !point.HasDepth()) continue;
    PointCandidate candidate;
    candidate.id = static_cast<LandmarkId>(i);
    candidate.position = world_from_cam * from.PointInCamera(static_cast<int>(i));
    candidate.descriptor = point.descriptor;
    candidate.level = point.level;
    if (ProjectCandidate(to.camera, to_cam_from_world, &candidate)) candidates.push_back(candidate);
  }
  return MatchPoints({}, to, candidates, radius, {});
}

}  // namespace msc_vo
