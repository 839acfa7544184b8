// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_fusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

std::vector<KeyframeId> Neighbours(const FusionOptions& options, const Map& map, KeyframeId id) {
  std::vector<KeyframeId> neighbours;
  for (const Map::Covisible& covisible : map.FindCovisible(id)) {
    if (static_cast<int>(neighbours.size()) == options.max_neighbours) break;
    neighbours.push_back(covisible.keyframe);
  }
  return neighbours;
}

// Returns the landmark that survives a merge, and the one that is merged into it.
template <typename L>
std::pair<LandmarkId, LandmarkId> SelectSurvivor(const L& a, const L& b) {
  const bool a_stays = a.observations.size() != b.observations.size()
                           ? a.observations.size() > b.observations.size()
                           : a.id < b.id;
  return a_stays ? std::make_pair(a.id, b.id) : std::make_pair(b.id, a.id);
}

std::vector<PointCandidate> PointsOf(const Map& map, const Keyframe& source,
                                     const Keyframe& target) {
  std::vector<PointCandidate> candidates;
  const Eigen::Vector3d center = target.cam_from_world.OriginInSource();
  for (const LandmarkId id : source.points) {
    const PointLandmark* point = map.FindPoint(id);
    if (point == nullptr || FindObservation(*point, target.id) != nullptr) continue;
    PointCandidate candidate;
    candidate.id = id;
    candidate.position = point->position;
    candidate.descriptor = point->descriptor;
    const double level = point->PredictLevel((point->position - center).norm());
    candidate.level = CellIndex(std::round(level), std::numeric_limits<int>::max());
    if (ProjectCandidate(target.frame->camera, target.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

std::vector<LineCandidate> LinesOf(const Map& map, const Keyframe& source, const Keyframe& target) {
  std::vector<LineCandidate> candidates;
  for (const LandmarkId id : source.lines) {
    const LineLandmark* line = map.FindLine(id);
    if (line == nullptr || FindObservation(*line, target.id) != nullptr) continue;
    LineCandidate candidate;
    candidate.id = id;
    candidate.segment = line->segment;
    candidate.descriptor = line->descriptor;
    if (ProjectCandidate(target.frame->camera, target.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

// Whether the measured depth, if any, agrees with the landmark at the 99 % quantile.
bool AgreesWithDepth(const Keyframe& keyframe, const PointFeature& feature,
                     const PointLandmark& point) {
  if (!feature.HasDepth()) return true;
  const double depth = (keyframe.cam_from_world * point.position).z();
  return depth > 0.0 &&
         std::abs(1.0 / depth - feature.inverse_depth) < 2.576 * feature.inverse_depth_sigma;
}

void FusePointsInto(const FusionOptions& options, KeyframeId source, KeyframeId target, Map* map) {
  const std::shared_ptr<const Frame> frame = map->FindKeyframe(target)->frame;
  const std::vector<PointMatch> matches = MatchPoints(
      options.point_matcher, *frame,
      PointsOf(*map, *map->FindKeyframe(source), *map->FindKeyframe(target)), options.radius, {});
  for (const PointMatch& match : matches) {
    const PointLandmark* point = map->FindPoint(match.id);
    if (point == nullptr) continue;                         // merged by an earlier match
    const Keyframe& keyframe = *map->FindKeyframe(target);  // earlier matches changed it
    if (!AgreesWithDepth(keyframe, frame->points[match.feature], *point)) continue;
    const PointLandmark* holder = map->FindPoint(keyframe.points[match.feature]);
    if (holder == nullptr) {
      map->ObservePoint(match.id, target, match.feature);
    } else if (holder->id != match.id) {
      const auto [survivor, duplicate] = SelectSurvivor(*point, *holder);
      map->MergePoints(duplicate, survivor);
    }
  }
}

bool AreOneLine(const FusionOptions& options, const Keyframe& keyframe, const LineSegment3& a,
                const LineSegment3& b) {
  if (UndirectedAngle(a.Direction(), b.Direction()) > DegreesToRadians(options.max_line_angle)) {
    return false;
  }
  const double distance = (a.Midpoint() - keyframe.cam_from_world.OriginInSource()).norm();
  return std::max(a.DistanceToLine(b.Midpoint()), b.DistanceToLine(a.Midpoint())) <
         options.max_line_offset * distance;
}

void FuseLinesInto(const FusionOptions& options, KeyframeId source, KeyframeId target, Map* map) {
  const std::shared_ptr<const Frame> frame = map->FindKeyframe(target)->frame;
  const std::vector<LineMatch> matches = MatchLines(
      options.line_matcher, *frame,
      LinesOf(*map, *map->FindKeyframe(source), *map->FindKeyframe(target)), options.radius, {});
  for (const LineMatch& match : matches) {
    const LineLandmark* line = map->FindLine(match.id);
    if (line == nullptr) continue;                          // merged by an earlier match
    const Keyframe& keyframe = *map->FindKeyframe(target);  // earlier matches changed it
    const LineLandmark* holder = map->FindLine(keyframe.lines[match.feature]);
    if (holder == nullptr) {
      map->ObserveLine(match.id, target, match.feature);
    } else if (holder->id != match.id &&
               AreOneLine(options, keyframe, line->segment, holder->segment)) {
      const auto [survivor, duplicate] = SelectSurvivor(*line, *holder);
      map->MergeLines(duplicate, survivor);
    }
  }
}

}  // namespace

bool FusionOptions::IsValid(std::string* error) const {
  if (!point_matcher.IsValid(error) || !line_matcher.IsValid(error)) return false;
  if (max_neighbours < 0) {
    *error = "fusion: max_neighbours must not be negative";
  } else if (!(radius > 0.0 && max_line_angle > 0.0 && max_line_offset > 0.0)) {
    *error = "fusion: radius, max_line_angle and max_line_offset must be positive";
  } else {
    return true;
  }
  return false;
}

void FusePoints(const FusionOptions& options, KeyframeId id, Map* map) {
  for (const KeyframeId neighbour : Neighbours(options, *map, id)) {
    FusePointsInto(options, id, neighbour, map);
    FusePointsInto(options, neighbour, id, map);
  }
}

void FuseLines(const FusionOptions& options, KeyframeId id, Map* map) {
  for (const KeyframeId neighbour : Neighbours(options, *map, id)) {
    FuseLinesInto(options, id, neighbour, map);
    FuseLinesInto(options, neighbour, id, map);
  }
}

void FuseLandmarks(const FusionOptions& options, Map* map) {
  std::vector<KeyframeId> keyframes;
  for (const auto& [id, keyframe] : map->keyframes()) keyframes.push_back(id);
  for (const KeyframeId id : keyframes) {
    FusePoints(options, id, map);
    FuseLines(options, id, map);
  }
}

}  // namespace msc_vo
