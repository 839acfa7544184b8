// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "msc_vo/map/path_covariance.h"

namespace msc_vo {

namespace {

// Landmarks that two keyframes share if they hold the map together.
constexpr int kMinShared = 20;
// Standard deviations of a pose in a window. A milliradian is a millimetre at 1 m.
constexpr double kSigma = 0.001;          // metres
constexpr double kRotationSigma = 0.001;  // radians

Rigid3 RelativePose(const Map& map, KeyframeId a, KeyframeId b) {
  return map.CamFromWorld(b) * map.CamFromWorld(a).Inverse();
}

// A step of odometry, or two keyframes that share landmarks.
struct Link {
  size_t a = 0, b = 0;  // positions of the keyframes in the map, a < b
  Rigid3 b_from_a;
  double extent = 0.0;   // ExtentOf() its path
  PoseCovariance drift;  // of the camera of b
};

// How much a camera moves on a path. A radian counts as a metre, since the systematic errors of
// both are 0.005.
double ExtentOf(const PathDrift& path) { return path.length() + path.turn().norm(); }

// The links of a map. Most steps are bridged by several: by their own and by those of pairs of
// keyframes before and after them.
class KeyframeLinks {
 public:
  KeyframeLinks(const Map& map, const SystematicDrift& systematic)
      : map_(map), systematic_(systematic) {
    for (const auto& [id, keyframe] : map.keyframes()) {
      positions_[id] = ids_.size();
      ids_.push_back(id);
      if (ids_.size() > 1) AddStep(ids_[ids_.size() - 2], id);
      for (const Map::Covisible& other : map.FindCovisible(id)) {
        if (other.num_shared < kMinShared) break;
        if (positions_.count(other.keyframe) > 0) AddPair(other.keyframe, id);
      }
    }
  }

  std::vector<PoseGraphEdge> Edges() const {
    const std::vector<double> sums = SumsOfBridgingLinks();
    std::vector<PoseGraphEdge> edges;
    for (const Link& link : links_) {
      double num_bridging = 1.0;
      if (systematic_.length + systematic_.turn > 0.0) {
        const double mean = (sums[link.b] - sums[link.a]) / static_cast<double>(link.b - link.a);
        num_bridging = std::max(1.0, mean);
      }
      const PoseCovariance camera = num_bridging * link.drift + CommonViewCovariance();
      edges.push_back(
          {ids_[link.a], ids_[link.b], link.b_from_a, CovarianceOfCamera(link.b_from_a, camera)});
    }
    return edges;
  }

 private:
  void AddStep(KeyframeId a, KeyframeId b) {
    const PathDrift drift = DriftBetween(map_, a, b);
    extents_.push_back(extents_.back() + ExtentOf(drift));
    Add(a, b, drift);
  }
  void AddPair(KeyframeId a, KeyframeId b) {
    if (positions_[b] == positions_[a] + 1) return;  // a step
    const Rigid3 b_from_a = RelativePose(map_, a, b);
    PathDrift drift;
    drift.AddError(b_from_a, *map_.StepCovariance(a));
    drift.AddStep(b_from_a, Rigid3(), *map_.StepCovariance(b));
    Add(a, b, drift);
  }
  // `drift`: base: `b`.
  void Add(KeyframeId a, KeyframeId b, const PathDrift& drift) {
    links_.push_back({positions_[a], positions_[b], RelativePose(map_, a, b), ExtentOf(drift),
                      drift.StepsAt(Rigid3()) +
                          SystematicCovariance(std::sqrt(systematic_.length * drift.length()),
                                               std::sqrt(systematic_.turn * drift.turn().norm()))});
  }

  // For every keyframe, the sum over the steps before it of the number of links that bridge the
  // step. A link counts by its extent relative to the path between its keyframes: one that closes
  // a loop does not repeat the steps of the path.
  std::vector<double> SumsOfBridgingLinks() const {
    std::vector<double> sums(ids_.size() + 1, 0.0);
    for (const Link& link : links_) {
      const double path = extents_[link.b] - extents_[link.a];
      const double weight = path > 0.0 ? link.extent / path : 1.0;
      sums[link.a + 1] += weight;
      sums[link.b + 1] -= weight;
    }
    for (int i = 0; i < 2; ++i) std::partial_sum(sums.begin(), sums.end(), sums.begin());
    return sums;
  }

  const Map& map_;
  SystematicDrift systematic_;
  std::vector<KeyframeId> ids_;
  std::map<KeyframeId, size_t> positions_;
  std::vector<double> extents_ = {0.0};  // sums up to each keyframe
  std::vector<Link> links_;
};

// The keyframe that stands for another one in the graph: itself, or the one before it if it was
// culled. kNoId if there is none: the one before it is of another session and may be anywhere, or
// the keyframe is of another map, or was culled before the map was saved.
KeyframeId Representative(const Map& map, KeyframeId id) {
  const auto* entry = map.KnowsKeyframe(id) ? map.keyframes().FindUpTo(id) : nullptr;
  const bool is_near =
      entry != nullptr && map.IsOfEarlierSession(entry->first) == map.IsOfEarlierSession(id);
  return is_near ? entry->first : kNoId;
}

// A loop between keyframes of the map, with the relative pose after later bundle adjustment;
// std::nullopt if it is of another map, or links a keyframe to itself.
std::optional<PoseGraphEdge> LoopBetweenKeyframes(const Map& map, const PoseGraphEdge& loop) {
  const KeyframeId from = Representative(map, loop.from), to = Representative(map, loop.to);
  if (from == kNoId || to == kNoId || from == to) return std::nullopt;
  const auto drift = [&map](KeyframeId a, KeyframeId b) {
    return DriftBetween(map, a, b).StepsAt(Rigid3());
  };
  PoseCovariance camera = CameraCovariance(loop.to_from_from, loop.covariance);
  if (from != loop.from) {
    camera += TransportCovariance(RelativePose(map, loop.from, loop.to), drift(from, loop.from));
  }
  if (to != loop.to) {
    camera = TransportCovariance(RelativePose(map, loop.to, to), camera) + drift(loop.to, to);
  }
  const Rigid3 to_from_from = RelativePose(map, from, to);
  return PoseGraphEdge{from, to, to_from_from, CovarianceOfCamera(to_from_from, camera)};
}

}  // namespace

PoseCovariance CommonViewCovariance() { return IsotropicCovariance(kRotationSigma, kSigma); }

PoseGraph MakeKeyframeGraph(const Map& map, const std::vector<PoseGraphEdge>& loops,
                            const SystematicDrift& systematic) {
  PoseGraph graph;
  for (const auto& [id, keyframe] : map.keyframes()) graph.poses[id] = keyframe.cam_from_world;
  graph.edges = KeyframeLinks(map, systematic).Edges();
  for (const PoseGraphEdge& loop : loops) {
    if (const auto edge = LoopBetweenKeyframes(map, loop)) graph.edges.push_back(*edge);
  }
  return graph;
}

std::vector<PoseGraphEdge> LoopsBetweenKeyframes(const std::vector<SavedSubMap>& submaps,
                                                 const std::vector<PoseGraphEdge>& loops) {
  std::vector<PoseGraphEdge> edges;
  for (const PoseGraphEdge& loop : loops) {
    for (const SavedSubMap& submap : submaps) {
      if (const auto edge = LoopBetweenKeyframes(submap.map, loop)) edges.push_back(*edge);
    }
  }
  return edges;
}

}  // namespace msc_vo
