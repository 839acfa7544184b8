// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// The alignments of the current map with inactive ones that frames could not distinguish, because
/// a map contains places that look alike. They remain possible where later frames fit one place
/// only, since the map may lack its look-alike.
class LookAlikes {
 public:
  /// Adds the alignment by a frame that was found in `map`, unless it is known. `snapshot`: what
  /// the frame is tracked in.
  void Add(const TrackedFrame& tracked, const MapSnapshot& snapshot, const Map& map,
           const Revisit& found);

  /// Whether the frame excludes all alignments with `map` except that of `found`. It excludes an
  /// alignment if it can match at least half as many landmarks at the pose by the alignment as at
  /// the pose that was found (NumMatchable), but the match ratio there is less than half as large.
  /// If it can match fewer, the same test at the pose on the other side of `found` decides.
  bool AreExcluded(const TrackerOptions& options, const TrackedFrame& tracked,
                   const MapSnapshot& snapshot, const Map& map, const Revisit& found) const;

  /// Forgets alignments of maps that the snapshot does not have.
  void Update(const MapSnapshot& snapshot);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [alignments] = *this;  // all members, or it does not compile
    archive(alignments);
  }

 private:
  // By a keyframe of either map, since both maps may be corrected.
  struct Alignment {
    KeyframeId own = kNoId;
    KeyframeId other = kNoId;
    Rigid3 other_from_own;  // camera to camera
  };

  // For each alignment, whether it places the frame where it was found, up to drift.
  std::vector<bool> AreSame(const TrackedFrame& tracked, const MapSnapshot& snapshot,
                            const Map& map, const Revisit& found) const;

  // The pose of the frame in the world of `map`.
  static Rigid3 PoseBy(const Alignment& alignment, const TrackedFrame& tracked, const Map& own,
                       const Map& map);

  std::vector<Alignment> alignments_;
};

}  // namespace msc_vo
