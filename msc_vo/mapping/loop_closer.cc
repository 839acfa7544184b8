// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/loop_closer.h"

#include <algorithm>
#include <utility>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/mapping/map_correction.h"

namespace msc_vo {

namespace {

// Keyframes after which a visit is forgotten: the camera has left the place.
constexpr KeyframeId kMaxAge = 10;

// Squared norm of a whitened error of six rows that is no larger than expected.
constexpr double kExpectedChiSquare = 6.0;

PoseGraphEdge EdgeOf(const KeyframeRevisit& visit) {
  const Revisit& revisit = visit.revisit;
  const PoseCovariance camera = revisit.covariance + CommonViewCovariance();
  return {revisit.reference, visit.keyframe, revisit.cam_from_reference,
          CovarianceOfCamera(revisit.cam_from_reference, camera)};
}

}  // namespace

void LoopCloser::AddKeyframe(const Map& map, KeyframeId keyframe, KeyframeId reference) {
  constexpr KeyframeId kInterval = 5;  // bounds the number of edges
  if (reference == kNoId || loop_edges_.empty()) return;
  const KeyframeId last = loop_edges_.back().to;
  if (reference >= last || keyframe < last + kInterval || !map.KnowsKeyframe(last)) return;
  const Rigid3 to_from_from = map.CamFromWorld(keyframe) * map.CamFromWorld(reference).Inverse();
  const PoseCovariance camera = *map.StepCovariance(keyframe) + CommonViewCovariance();
  loop_edges_.push_back(
      {reference, keyframe, to_from_from, CovarianceOfCamera(to_from_from, camera)});
}

void LoopCloser::AddRevisit(const KeyframeRevisit& visit) {
  const KeyframeId oldest = visit.keyframe - kMaxAge;
  EraseIf(&visits_, [oldest](const KeyframeRevisit& other) { return other.keyframe < oldest; });
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

double LoopCloser::SquaredError(const Map& map, const PoseGraphEdge& edge, const PathDrift& path,
                                double factor) const {
  const Rigid3 by_path = map.CamFromWorld(edge.to) * map.CamFromWorld(edge.from).Inverse();
  return SquaredDriftError(
      by_path, edge.to_from_from,
      path.At(Rigid3(), factor) + CameraCovariance(edge.to_from_from, edge.covariance));
}

double LoopCloser::SystematicFactor(const Map& map, const PoseGraphEdge& edge,
                                    const PathDrift& path) const {
  for (const double factor : {0.125, 0.25, 0.5}) {
    if (SquaredError(map, edge, path, factor) <= kExpectedChiSquare) return factor;
  }
  return 1.0;
}

std::optional<PoseGraph> LoopCloser::Correct(const Map& map,
                                             const std::vector<PoseGraphEdge>& new_edges,
                                             const SystematicDrift& systematic) const {
  PoseGraph graph = MakeKeyframeGraph(map, loop_edges_, systematic);
  graph.edges.insert(graph.edges.end(), new_edges.begin(), new_edges.end());
  const std::vector<double> squared_errors = OptimizePoseGraph(&graph);
  const bool is_consistent =
      !squared_errors.empty() &&
      *std::max_element(squared_errors.begin(), squared_errors.end()) <= kOutlierChiSquare[6];
  return is_consistent ? std::optional<PoseGraph>(std::move(graph)) : std::nullopt;
}

std::optional<LoopClosure> LoopCloser::TryClose(Map* map) {
  EraseIf(&visits_, [map](const KeyframeRevisit& visit) {
    return map->FindKeyframe(visit.keyframe) == nullptr ||
           map->FindKeyframe(visit.revisit.reference) == nullptr;
  });
  const std::vector<KeyframeRevisit> visits = AgreeingVisits(*map);
  if (visits.empty()) return std::nullopt;
  const auto refuse = [this] {
    visits_.clear();
    ++num_refused_;
    return std::nullopt;
  };
  std::vector<PoseGraphEdge> new_edges;
  SystematicDrift systematic;
  for (const KeyframeRevisit& visit : visits) {
    const PoseGraphEdge edge = EdgeOf(visit);
    const PathDrift path = PathCovariances(*map, loop_edges_, edge.to).DriftTo(edge.from);
    if (SquaredError(*map, edge, path, 1.0) >= kOutlierChiSquare[6]) return refuse();
    new_edges.push_back(edge);
    const double factor = SystematicFactor(*map, edge, path);
    systematic.length = std::max(systematic.length, factor * factor * path.length());
    systematic.turn = std::max(systematic.turn, factor * factor * path.turn().norm());
  }
  std::optional<PoseGraph> graph = Correct(*map, new_edges, {});
  const bool is_first = !std::exchange(is_contradicted_, !graph);
  if (!graph && !is_first) graph = Correct(*map, new_edges, systematic);
  if (!graph) return refuse();
  is_contradicted_ = false;
  const KeyframeId newest = visits.back().keyframe;
  const Rigid3 old_cam_from_world = map->CamFromWorld(newest);
  MoveKeyframes(graph->poses, map);
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
