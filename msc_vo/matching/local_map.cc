// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/local_map.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/map/id_set.h"
#include "msc_vo/map/observer_count.h"

namespace msc_vo {

namespace {

// Highest pyramid level of the extractor's default.
constexpr int kMaxLevel = 7;
// Cosine of the largest viewing-angle difference, 60 degrees: beyond it ORB descriptors change.
constexpr double kMinViewingCosine = 0.5;

// The keyframes that observe the matched landmarks, most shared landmarks first.
std::vector<Map::Covisible> RankObservers(const Map& map, const FrameMatches& matches) {
  ObserverCount observers(map);
  const auto count = [&observers](const Landmark* landmark) {
    if (landmark != nullptr) observers.Add(*landmark);
  };
  for (const PointMatch& match : matches.points) {
    if (match.inlier) count(map.Find<PointLandmark>(match.id));
  }
  for (const LineMatch& match : matches.lines) {
    if (match.inlier) count(map.Find<LineLandmark>(match.id));
  }
  return observers.Ranked();
}

std::set<KeyframeId> SelectKeyframes(const Map& map, const FrameMatches& matches,
                                     KeyframeId fallback, int max_keyframes,
                                     KeyframeId* reference) {
  std::vector<Map::Covisible> ranked = RankObservers(map, matches);
  if (ranked.empty()) ranked.push_back({fallback, 0});
  *reference = ranked.front().keyframe;
  std::set<KeyframeId> selected;
  for (const Map::Covisible& observer : ranked) {
    if (static_cast<int>(selected.size()) >= max_keyframes) return selected;
    selected.insert(observer.keyframe);
  }
  // Covisible keyframes of the best one observe landmarks that are about to enter the view.
  for (const Map::Covisible& covisible : map.FindCovisible(*reference)) {
    if (static_cast<int>(selected.size()) >= max_keyframes) break;
    selected.insert(covisible.keyframe);
  }
  return selected;
}

void AddLandmarks(const std::vector<LandmarkId>& observed, IdSet* landmarks) {
  for (const LandmarkId id : observed) {
    if (id != kNoId) landmarks->Insert(id);
  }
}

// Highest level that the frame may have features of; nearer points cannot be matched.
int HighestLevel(const Frame& frame) {
  int level = kMaxLevel;
  for (const PointFeature& point : frame.points) level = std::max(level, point.level);
  return level;
}

// Whether the ray from the camera to the landmark is close to its mean viewing direction.
bool HasSimilarViewingAngle(const Landmark& landmark, const Eigen::Vector3d& ray) {
  return landmark.viewing_direction.dot(ray) >= kMinViewingCosine * ray.norm();
}

PointCandidate CandidateOf(const PointLandmark& point) {
  PointCandidate candidate;
  candidate.id = point.id;
  candidate.position = point.position;
  candidate.descriptor = point.descriptor;
  return candidate;
}

LineCandidate CandidateOf(const LineLandmark& line) {
  LineCandidate candidate;
  candidate.id = line.id;
  candidate.segment = line.segment;
  candidate.descriptor = line.descriptor;
  return candidate;
}

void AddPoint(const PointLandmark& point, const Frame& frame, const Rigid3& cam_from_world,
              const Eigen::Vector3d& center, int highest_level,
              std::vector<PointCandidate>* candidates) {
  const Eigen::Vector3d ray = point.position - center;
  if (!HasSimilarViewingAngle(point, ray)) return;
  const double level = point.PredictLevel(ray.norm());
  // One level of tolerance on both sides, as in the matcher.
  if (!(level > -1.5 && level < highest_level + 1.5)) return;
  PointCandidate candidate = CandidateOf(point);
  candidate.level = std::clamp(static_cast<int>(std::lround(level)), 0, highest_level);
  if (ProjectCandidate(frame.camera, cam_from_world, &candidate)) candidates->push_back(candidate);
}

// The same for a line. Of one that passes the camera, only the direction across it is compared: its
// middle may be behind, and views along a line differ little in its descriptor.
bool HasSimilarViewingAngle(const LineLandmark& line, const Rigid3& cam_from_world,
                            const Eigen::Vector3d& center) {
  const Eigen::Vector3d ray = line.segment.Midpoint() - center;
  if (IsInFront(cam_from_world * line.segment)) return HasSimilarViewingAngle(line, ray);
  const Eigen::Vector3d along = line.segment.Direction();
  const Eigen::Vector3d mean = line.viewing_direction;
  const Eigen::Vector3d ray_across = ray - along.dot(ray) * along;
  const Eigen::Vector3d mean_across = mean - along.dot(mean) * along;
  return mean_across.dot(ray_across) >= kMinViewingCosine * mean_across.norm() * ray_across.norm();
}

void AddLine(const LineLandmark& line, const Frame& frame, const Rigid3& cam_from_world,
             const Eigen::Vector3d& center, std::vector<LineCandidate>* candidates) {
  if (!HasSimilarViewingAngle(line, cam_from_world, center)) return;
  LineCandidate candidate = CandidateOf(line);
  if (ProjectCandidate(frame.camera, cam_from_world, &candidate)) candidates->push_back(candidate);
}

}  // namespace

LocalMap LandmarksOf(const Map& map, const Keyframe& keyframe) {
  LocalMap landmarks;
  landmarks.reference = keyframe.id;
  for (const LandmarkId id : keyframe.points) {
    if (id != kNoId) landmarks.points.push_back(CandidateOf(*map.Find<PointLandmark>(id)));
  }
  for (const LandmarkId id : keyframe.lines) {
    if (id != kNoId) landmarks.lines.push_back(CandidateOf(*map.Find<LineLandmark>(id)));
  }
  return landmarks;
}

LocalMap SelectLocalMap(const Map& map, const Frame& frame, const Rigid3& cam_from_world,
                        const FrameMatches& matches, KeyframeId fallback, int max_keyframes) {
  LocalMap local;
  const std::set<KeyframeId> keyframes =
      SelectKeyframes(map, matches, fallback, max_keyframes, &local.reference);
  IdSet points(map.points());
  IdSet lines(map.lines());
  for (const KeyframeId id : keyframes) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    AddLandmarks(keyframe.points, &points);
    AddLandmarks(keyframe.lines, &lines);
  }
  const Eigen::Vector3d center = cam_from_world.OriginInSource();
  const int highest_level = HighestLevel(frame);
  points.VisitAll([&](LandmarkId id) {
    AddPoint(*map.Find<PointLandmark>(id), frame, cam_from_world, center, highest_level,
             &local.points);
  });
  lines.VisitAll([&](LandmarkId id) {
    AddLine(*map.Find<LineLandmark>(id), frame, cam_from_world, center, &local.lines);
  });
  return local;
}

LocalMap SelectVisibleLandmarks(const Map& map, const Frame& frame, const Rigid3& cam_from_world) {
  LocalMap local;
  const Eigen::Vector3d center = cam_from_world.OriginInSource();
  const int highest_level = HighestLevel(frame);
  for (const auto& [id, point] : map.points()) {
    AddPoint(point, frame, cam_from_world, center, highest_level, &local.points);
  }
  for (const auto& [id, line] : map.lines()) {
    AddLine(line, frame, cam_from_world, center, &local.lines);
  }
  return local;
}

}  // namespace msc_vo
