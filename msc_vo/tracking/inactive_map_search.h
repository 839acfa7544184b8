// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>
#include <optional>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Searches the inactive maps of older segments for the place that tracked frames show, so that the
/// maps can be joined.
class InactiveMapSearch {
 public:
  explicit InactiveMapSearch(const TrackerOptions& options) : options_(options) {}

  /// Tries to relocalise a frame of status kTracked in the inactive maps of `snapshot`, against
  /// one of their keyframes in 1/30 s, `seconds` after the frame before (KeyframesToTry): from
  /// newest to oldest, cyclically. After a success it pauses for SegmentOptions::search_interval,
  /// so that the next frame that is found has a different view, and begins with the same keyframe,
  /// at most six times: if the maps have not been joined by then, that keyframe may show another
  /// place that looks alike.
  std::optional<MapRelocalization> Search(const TrackedFrame& tracked, const MapSnapshot& snapshot,
                                          double seconds);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, next, successes, last_success] = *this;  // all members, or it does not compile
    archive(next, successes, last_success);
  }

 private:
  // The next keyframe that is to be tried, and its map.
  struct Candidate {
    const Map* map = nullptr;
    const Keyframe* keyframe = nullptr;
  };
  Candidate NextCandidate(const InactiveMaps& maps);
  std::optional<MapRelocalization> Relocalize(const TrackedFrame& tracked,
                                              const NoiseScale& noise_scale, const Map& map,
                                              const Keyframe& keyframe) const;

  TrackerOptions options_;
  KeyframeId next_ = std::numeric_limits<KeyframeId>::max();
  int num_successes_ = 0;  // consecutive ones, with the keyframe next_
  double last_success_ = -std::numeric_limits<double>::infinity();  // seconds
};

}  // namespace msc_vo
