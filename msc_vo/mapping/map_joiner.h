// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/atlas.h"
#include "msc_vo/map/map_alignment.h"
#include "msc_vo/matching/map_relocalization.h"

namespace msc_vo {

/// Two maps that became one. Maps are named by their first keyframes.
struct MapJoin {
  KeyframeId kept = kNoId;   ///< the map whose world was kept
  KeyframeId moved = kNoId;  ///< the map that was moved into that world
  Rigid3 moved_from_kept;    ///< world to world
  /// Of `moved_from_kept`, in the tangent of Rigid3Manifold.
  PoseCovariance covariance = PoseCovariance::Zero();
  int num_keyframes = 0;  ///< that agree on the alignment

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, kept, moved, moved_from_kept, covariance, num_keyframes);
  }
};

/// Joins the current map with an inactive one when enough keyframes have been found in both.
class MapJoiner {
 public:
  explicit MapJoiner(const MapAlignmentOptions& options) : options_(options) {}

  /// Adds a keyframe of the current map that was found in an inactive one. `covariance`: of its
  /// pose in the current map.
  void Add(KeyframeId keyframe, const PoseCovariance& covariance,
           const MapRelocalization& in_inactive_map);

  /// Aligns the current map with the inactive one that keyframes were found in last, joins the two
  /// if the keyframes agree (AlignMaps), and merges the landmarks that both maps have of the same
  /// features. std::nullopt if they are not joined.
  std::optional<MapJoin> TryJoin(Atlas* atlas);

  /// Forgets the keyframes of the current map: another one begins.
  void Clear() { common_keyframes_.clear(); }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, common_keyframes] = *this;  // all members, or it does not compile
    archive(common_keyframes);
  }

 private:
  // A keyframe of the current map in an inactive one.
  struct CommonKeyframe {
    KeyframeId keyframe = kNoId;
    PoseCovariance covariance = PoseCovariance::Zero();
    MapRelocalization in_inactive_map;

    template <typename Archive>
    void Serialize(Archive& archive) {
      archive.Fields(*this, keyframe, covariance, in_inactive_map);
    }
  };

  // Those that were found in `map`.
  std::vector<CommonKeyframe> CommonKeyframesWith(const Map& map) const;

  MapAlignmentOptions options_;
  std::vector<CommonKeyframe> common_keyframes_;
};

}  // namespace msc_vo
