// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/last_tracked_pose.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/mapping/keyframe_revisit.h"

namespace msc_vo {

/// Two submaps that became one.
struct MapJoin {
  SubMapId kept = kNoSubMap;   ///< the one whose world and id were kept
  SubMapId moved = kNoSubMap;  ///< the one that was moved into that world
  Rigid3 moved_from_kept;      ///< world to world
  /// Of `moved_from_kept`, in the tangent of Rigid3Manifold.
  PoseCovariance covariance = PoseCovariance::Zero();
  int num_keyframes = 0;  ///< that agree on the alignment
};

/// Joins the current map with an inactive one when enough keyframes have been found in both.
class MapJoiner {
 public:
  /// Adds a keyframe of the current map that was found in an inactive one.
  void Add(const KeyframeRevisit& found) { AddRecent(found, &common_keyframes_); }

  /// Aligns the current map with the inactive one that keyframes were found in last, joins the two
  /// if the keyframes agree (AlignMaps), the camera can have moved from one map into the other in
  /// the time that it had (MotionLimits), and the Manhattan axes of both are parallel, and merges
  /// the landmarks that both maps have of the same features. std::nullopt if they are not joined;
  /// keyframes that agree on an impossible motion or on other axes are forgotten.
  std::optional<MapJoin> TryJoin(Atlas* atlas);

  /// Alignments of the run so far that keyframes agreed on, but that motion or axes rejected.
  int num_refused() const { return num_refused_; }

  /// Forgets the keyframes of the current map: another one begins.
  void Clear() { common_keyframes_.clear(); }

  /// Adds the last pose in a map that becomes inactive.
  void AddLastPose(const LastTrackedPose& pose) { last_poses_.push_back(pose); }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [common_keyframes, last_poses, refused] = *this;  // all members, or it does not compile
    archive(common_keyframes, last_poses, refused);
  }

 private:
  // The pose of a keyframe, or the last one in its map.
  struct PoseInMap {
    double timestamp = 0.0;  // seconds
    Rigid3 cam_from_world;
    const Map* map = nullptr;
    bool is_last = false;
  };

  // Appends those of this session.
  void AppendPoses(const Map& map, const Rigid3& map_from_world,
                   std::vector<PoseInMap>* poses) const;
  // Whether the camera can have moved from one map into the other in the time that it had. Nothing
  // is known of the time between sessions.
  bool IsPossibleMotion(const Map& a, const Map& b, const Rigid3& a_from_b) const;
  // Forgets those of `keyframes` that are marked.
  void Forget(const std::vector<KeyframeRevisit>& keyframes, const std::vector<bool>& forgotten);
  // Those that were found in `map`.
  std::vector<KeyframeRevisit> CommonKeyframesWith(const Map& map) const;

  std::vector<KeyframeRevisit> common_keyframes_;  // of the current map and an inactive one
  std::vector<LastTrackedPose> last_poses_;
  int num_refused_ = 0;
};

}  // namespace msc_vo
