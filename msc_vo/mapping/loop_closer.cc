// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/loop_closer.h"

#include <algorithm>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/map/path_covariance.h"
#include "msc_vo/mapping/map_correction.h"

namespace msc_vo {

namespace {

// Keyframes after which a visit is forgotten: the camera has left the place.
constexpr KeyframeId kMaxAge = 10;
// Landmarks that two keyframes share if they hold the map together.
constexpr int kMinShared = 20;
// Standard deviations of an edge of the graph beyond its covariance: those of a pose in a window,
// of which the covariance of coinciding keyframes has nothing. A milliradian is a millimetre at 1
// m.
constexpr double kEdgeSigma = 0.001;          // metres
constexpr double kEdgeRotationSigma = 0.001;  // radians

PoseCovariance EdgeCovariance() { return IsotropicCovariance(kEdgeRotationSigma, kEdgeSigma); }

}  // namespace

void LoopCloser::AddKeyframe(const Map& map, KeyframeId keyframe, KeyframeId reference) {
  constexpr KeyframeId kInterval = 5;  // bounds the number of edges
  if (reference == kNoId || loop_edges_.empty()) return;
  const KeyframeId last = loop_edges_.back().to;
  if (reference >= last || keyframe < last + kInterval || !map.KnowsKeyframe(last)) return;
  const Rigid3 to_from_from = map.CamFromWorld(keyframe) * map.CamFromWorld(reference).Inverse();
  const PoseCovariance camera = *map.StepCovariance(keyframe) + EdgeCovariance();
  loop_edges_.push_back(
      {reference, keyframe, to_from_from, CovarianceOfCamera(to_from_from, camera)});
}

void LoopCloser::AddRevisit(const KeyframeRevisit& visit) {
  const KeyframeId oldest = visit.keyframe - kMaxAge;
  visits_.erase(
      std::remove_if(visits_.begin(), visits_.end(),
                     [oldest](const KeyframeRevisit& other) { return other.keyframe < oldest; }),
      visits_.end());
  AddRecent(visit, &visits_);
}

std::vector<KeyframeRevisit> LoopCloser::AgreeingVisits(const Map& map) const {
  std::vector<FrameInTwoMaps> frames;
  for (const KeyframeRevisit& visit : visits_) frames.push_back(InTwoMaps(visit, map, map));
  const std::optional<MapAlignment> alignment = AlignMaps(frames);
  std::vector<KeyframeRevisit> agreeing;
  for (size_t i = 0; alignment && i < visits_.size(); ++i) {
    if (alignment->inliers[i]) agreeing.push_back(visits_[i]);
  }
  return agreeing;
}

PoseGraphEdge LoopCloser::EdgeOf(const Map& map, const KeyframeRevisit& visit) const {
  const Revisit& revisit = visit.revisit;
  const Rigid3 cam_from_world = revisit.cam_from_reference * map.CamFromWorld(revisit.reference);
  const PoseCovariance camera =
      CameraCovariance(cam_from_world, revisit.covariance) + EdgeCovariance();
  return {revisit.reference, visit.keyframe, revisit.cam_from_reference,
          CovarianceOfCamera(revisit.cam_from_reference, camera)};
}

bool LoopCloser::IsPossible(const Map& map, const KeyframeRevisit& visit) const {
  const PoseGraphEdge edge = EdgeOf(map, visit);
  const Rigid3 by_path = map.CamFromWorld(edge.to) * map.CamFromWorld(edge.from).Inverse();
  return IsPossibleDrift(by_path, edge.to_from_from,
                         PathCovariances(map, loop_edges_, edge.to).OfRoot(edge.from) +
                             CameraCovariance(edge.to_from_from, edge.covariance));
}

PoseGraph LoopCloser::MakeGraph(const Map& map) const {
  PoseGraph graph;
  const auto add = [&](KeyframeId from, KeyframeId to, const PoseCovariance& camera) {
    const Rigid3 to_from_from = map.CamFromWorld(to) * map.CamFromWorld(from).Inverse();
    graph.edges.push_back({from, to, to_from_from, CovarianceOfCamera(to_from_from, camera)});
  };
  KeyframeId last = kNoId;
  for (const auto& [id, keyframe] : map.keyframes()) {
    graph.poses[id] = keyframe.cam_from_world;
    if (last != kNoId) add(last, id, PathCovariance(map, last, id) + EdgeCovariance());
    for (const Map::Covisible& other : map.FindCovisible(id)) {
      if (other.num_shared < kMinShared) break;
      if (other.keyframe >= last) continue;  // each pair once, and none of the path twice
      const Rigid3 to_from_from =
          keyframe.cam_from_world * map.CamFromWorld(other.keyframe).Inverse();
      add(other.keyframe, id,
          TransportCovariance(to_from_from, *map.StepCovariance(other.keyframe)) +
              *map.StepCovariance(id) + EdgeCovariance());
    }
    last = id;
  }
  // A keyframe that was culled is represented by the one before it, unless that is of another
  // session and may be anywhere. The map does not know those of other maps, nor those that were
  // culled before it was saved.
  const auto represent = [&map](KeyframeId id) {
    const auto* entry = map.KnowsKeyframe(id) ? map.keyframes().FindUpTo(id) : nullptr;
    const bool is_near =
        entry != nullptr && map.IsOfEarlierSession(entry->first) == map.IsOfEarlierSession(id);
    return is_near ? entry : nullptr;
  };
  for (const PoseGraphEdge& edge : loop_edges_) {
    // With the relative pose after later bundle adjustment.
    const auto *from = represent(edge.from), *to = represent(edge.to);
    if (from == nullptr || to == nullptr || from->first == to->first) continue;
    add(from->first, to->first, CameraCovariance(edge.to_from_from, edge.covariance));
  }
  return graph;
}

std::optional<LoopClosure> LoopCloser::TryClose(Map* map) {
  visits_.erase(std::remove_if(visits_.begin(), visits_.end(),
                               [map](const KeyframeRevisit& visit) {
                                 return map->FindKeyframe(visit.keyframe) == nullptr ||
                                        map->FindKeyframe(visit.revisit.reference) == nullptr;
                               }),
                visits_.end());
  const std::vector<KeyframeRevisit> visits = AgreeingVisits(*map);
  if (visits.empty()) return std::nullopt;
  const auto refuse = [this] {
    visits_.clear();
    ++num_refused_;
    return std::nullopt;
  };
  PoseGraph graph = MakeGraph(*map);
  std::vector<PoseGraphEdge> new_edges;
  for (const KeyframeRevisit& visit : visits) {
    if (!IsPossible(*map, visit)) return refuse();
    new_edges.push_back(EdgeOf(*map, visit));
  }
  graph.edges.insert(graph.edges.end(), new_edges.begin(), new_edges.end());
  const std::vector<double> squared_errors = OptimizePoseGraph(&graph);
  if (squared_errors.empty() ||
      *std::max_element(squared_errors.begin(), squared_errors.end()) > kOutlierChiSquare[6]) {
    return refuse();
  }
  const KeyframeId newest = visits.back().keyframe;
  const Rigid3 old_cam_from_world = map->CamFromWorld(newest);
  MoveKeyframes(graph.poses, map);
  for (const KeyframeRevisit& visit : visits) {
    MergeMatches(visit.keyframe, visit.revisit.matches, map);
  }
  loop_edges_.insert(loop_edges_.end(), new_edges.begin(), new_edges.end());
  visits_.clear();
  ++num_closed_;
  return LoopClosure{newest, visits.back().revisit.reference, static_cast<int>(visits.size()),
                     map->CamFromWorld(newest) * old_cam_from_world.Inverse()};
}

}  // namespace msc_vo
