// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

/// Maps that frames are not tracked in. Any thread may read them.
using InactiveMaps = std::vector<std::shared_ptr<const Map>>;

/// The map of `maps` that contains or contained the keyframe; nullptr if there is none.
const Map* FindMapOf(const InactiveMaps& maps, KeyframeId keyframe);

/// The maps of a run. A run begins with one map. When that is left behind, a new segment of the run
/// begins with a map of its own, and the old one becomes inactive until the two are joined. Ids of
/// keyframes and landmarks are unique over all maps.
class Atlas {
 public:
  /// The map that frames are tracked in.
  const Map& current() const { return current_; }
  Map& current() { return current_; }
  /// The other maps, in the order in which they became inactive.
  const InactiveMaps& inactive() const { return inactive_; }

  /// Begins a new map. The current one becomes inactive, or is discarded unless `keep_current`.
  void Begin(bool keep_current);

  /// Joins the current map with the inactive one that contains keyframe `other`. The world of the
  /// older map, which is the one with the first keyframe, is kept. Returns false and does nothing
  /// if no inactive map contains the keyframe.
  bool Join(KeyframeId other, const Rigid3& current_from_other_world);

  /// All maps as they are, the current one last. They share memory with the atlas.
  InactiveMaps ShareAll();
  /// Changes all maps.
  void ChangeAll(const std::function<void(Map*)>& change);

  /// The map that contains or contained the keyframe; nullptr if that was discarded.
  const Map* FindMapOf(KeyframeId keyframe) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [current_map, inactive_maps] = *this;  // all members, or it does not compile
    archive(current_map, inactive_maps);
  }

 private:
  Map current_;
  InactiveMaps inactive_;
};

/// Whether the world of `a` is kept when it is joined with `b`: it has the first keyframe. Neither
/// map may be empty.
bool IsOlder(const Map& a, const Map& b);

}  // namespace msc_vo
