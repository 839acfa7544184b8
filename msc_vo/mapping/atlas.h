// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/inactive_maps.h"
#include "msc_vo/map/map_contents.h"
#include "msc_vo/mapping/submap.h"

namespace msc_vo {

/// The submaps of a run. A run begins with one. When that is left behind, a new segment of the run
/// begins with a submap of its own, and the old one becomes inactive until the two are joined. Ids
/// of keyframes and landmarks are unique over all submaps.
class Atlas {
 public:
  /// `axes`, `noise`: options of the estimators of its submaps. Throws std::invalid_argument if
  /// they are not valid.
  Atlas(const SceneAxesOptions& axes, const NoiseEstimatorOptions& noise);

  /// The submap that frames are tracked in.
  const SubMap& current() const { return current_; }
  SubMap& current() { return current_; }
  /// The maps of the other submaps, in the order in which they became inactive.
  const InactiveMaps& inactive_maps() const { return inactive_maps_; }

  /// Begins with the submaps of earlier sessions, by ascending id, as inactive ones. They have the
  /// ids 0, 1, ..., and the current one the next id. Call it before the first keyframe.
  void BeginWith(std::vector<SavedSubMap> submaps);
  /// Begins a submap as Begin(true) does, with one of an earlier session. Its ids must differ from
  /// those of the other submaps.
  void BeginWith(SavedSubMap submap);
  /// All submaps that are not empty, by ascending id. They share memory with the atlas.
  std::vector<SavedSubMap> ShareSubMaps();

  /// Begins a submap. The current one becomes inactive, or is discarded unless `keep_current`: the
  /// new one then has its id. The noise, which is that of the sensor, is continued.
  void Begin(bool keep_current);

  /// Joins the current submap with the inactive one that contains keyframe `other`. The id, the
  /// world and the axes of the older one are kept; axes of the other world are re-estimated, not
  /// rotated. Returns false and does nothing if no inactive submap contains the keyframe.
  bool Join(KeyframeId other, const Rigid3& current_from_other_world);

  /// All maps as they are, the current one last. They share memory with the atlas.
  InactiveMaps ShareAll();
  /// Changes all submaps.
  void ChangeAll(const std::function<void(SubMap*)>& change);

  /// nullptr: it was discarded, or joined with an older one.
  const SubMap* Find(SubMapId id) const;
  /// The submap whose map contains or contained the keyframe; nullptr if that was discarded.
  const SubMap* FindSubMapOf(KeyframeId keyframe) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [axes, noise, next_id, current_submap, inactive, maps] = *this;  // all members
    archive(next_id, current_submap);
    archive.Entries(inactive, [this] { return MakeEmpty(); });
    archive(maps);
  }

 private:
  // Without an id.
  SubMap MakeEmpty() const;
  SubMap Restored(SavedSubMap saved) const;

  SceneAxesOptions axes_;
  NoiseEstimatorOptions noise_;
  SubMapId next_id_ = 1;
  SubMap current_;
  std::vector<SubMap> inactive_;
  InactiveMaps inactive_maps_;  // the maps of inactive_
};

/// Whether the world of `a` is kept when it is joined with `b`.
inline bool IsOlder(const SubMap& a, const SubMap& b) { return a.id < b.id; }

}  // namespace msc_vo
