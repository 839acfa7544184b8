// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/path_covariance.h"
#include "msc_vo/mapping/keyframe_graph.h"
#include "msc_vo/mapping/keyframe_revisit.h"
#include "msc_vo/pose_estimation/pose_graph.h"

namespace msc_vo {

/// A loop that was closed: the map shows one place once again.
struct LoopClosure {
  KeyframeId keyframe = kNoId;   ///< the newest one of the place
  KeyframeId reference = kNoId;  ///< an older keyframe that shows the same place
  int num_keyframes = 0;         ///< that agree on it
  /// Pose of `keyframe` after the correction relative to before it, in its camera frame.
  Rigid3 new_from_old_camera;
};

/// Closes loops of a map. A loop is accepted if no test rejects it: several keyframes of a short
/// part of the path agree on it, the correction is possible by the covariance of the path between
/// both visits, and afterwards no edge of the pose graph contradicts another. A missed loop costs
/// accuracy, a false one the map.
class LoopCloser {
 public:
  /// Adds the newest keyframe, which was tracked relative to keyframe `reference`. If that is older
  /// than the last edge, the camera is in a part of the map that closed loops have made consistent:
  /// every fifth such keyframe gets an edge, so that the path to it does not lead through all
  /// rounds.
  void AddKeyframe(const Map& map, KeyframeId keyframe, KeyframeId reference);
  /// Adds the newest keyframe, which shows an older part of the map.
  void AddRevisit(const KeyframeRevisit& visit);

  /// Adds the loops of earlier sessions.
  void AddEdges(const std::vector<PoseGraphEdge>& edges) {
    loop_edges_.insert(loop_edges_.end(), edges.begin(), edges.end());
  }
  /// The measured poses of all closed loops, and of keyframes in known parts of the map.
  const std::vector<PoseGraphEdge>& edges() const { return loop_edges_; }

  /// Closes the loop of the last revisit if it is accepted: corrects the poses of all keyframes and
  /// their landmarks, and merges the landmarks that both visits have of the same features.
  std::optional<LoopClosure> TryClose(Map* map);

  /// Loops of the run so far.
  int num_closed() const { return num_closed_; }
  /// Loops of the run so far that keyframes agreed on, but that were not accepted.
  int num_refused() const { return num_refused_; }

  /// Forgets the revisits: another map begins, or two are joined.
  void Clear() {
    visits_.clear();
    is_contradicted_ = false;
  }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [visits, edges, closed, refused, contradicted] = *this;  // all members
    archive(visits, edges, closed, refused, contradicted);
  }

 private:
  // The recent visits that agree on a correction; empty if too few do.
  std::vector<KeyframeRevisit> AgreeingVisits(const Map& map) const;
  // Squared norm of the whitened error of the path between the keyframes of a loop, if its
  // systematic error is `factor` times that of the model. `path`: base: `edge.to`.
  double SquaredError(const Map& map, const PoseGraphEdge& edge, const PathDrift& path,
                      double factor) const;
  // The pose graph of the map with further edges, solved; std::nullopt if an edge contradicts.
  // `systematic`: see MakeKeyframeGraph().
  std::optional<PoseGraph> Correct(const Map& map, const std::vector<PoseGraphEdge>& new_edges,
                                   const SystematicDrift& systematic) const;
  // The smallest of 1/8, 1/4, 1/2 and 1 by which the systematic error of the model is to be
  // multiplied so that the error of the path is no larger than expected; 1 if none suffices.
  double SystematicFactor(const Map& map, const PoseGraphEdge& edge, const PathDrift& path) const;

  std::vector<KeyframeRevisit> visits_;
  std::vector<PoseGraphEdge> loop_edges_;  // beside those along the path
  int num_closed_ = 0;
  int num_refused_ = 0;
  // The last loop contradicted the graph with independent errors. It may be inaccurate, found in a
  // distant view: systematic errors explain it if the next one contradicts, too.
  bool is_contradicted_ = false;
};

}  // namespace msc_vo
