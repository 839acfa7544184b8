// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/place_recognition/place_index.h"
#include "msc_vo/tracking/look_alikes.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// Returns how many of the `num_keyframes` of a map are tried in a frame that follows the previous
/// one after `seconds`, so that their number per second, and with it the cost, does not depend on
/// the frame rate: `keyframes_per_interval` in 1/30 s, at least one, and after a gap no more than
/// in 0.2 s. Beyond `keyframes_per_interval`, none is tried twice.
int KeyframesToTry(int keyframes_per_interval, double seconds, size_t num_keyframes);

/// Which of the keyframes that look like a frame are tried next. The best one is tried first, but
/// another place may look alike: the others are tried cyclically.
class TryOrder {
 public:
  /// Selects at most `num` of `ranked`, best first. If it selects one at a time, every second one
  /// is the best; otherwise the first is.
  std::vector<KeyframeId> Select(const std::vector<KeyframeId>& ranked, int num);

  /// Begins again: a keyframe was found.
  void Reset() { *this = {}; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [frames, others] = *this;  // all members, or it does not compile
    archive(frames, others);
  }

 private:
  int num_frames_ = 0;
  int num_others_ = 0;  // selected so far
};

/// Recognises the places that frames show among the keyframes of all maps.
class PlaceSearch {
 public:
  explicit PlaceSearch(const TrackerOptions& options) : options_(options) {}

  /// Adopts the keyframes of the snapshot that the next frame is tracked in.
  void Update(const MapSnapshot& snapshot);

  /// The keyframes of `map` that relocalisation tries in a frame, at most `num`.
  std::vector<KeyframeId> SelectKeyframes(const Frame& frame, const Map& map, int num,
                                          TryOrder* order) const;

  /// Searches the inactive maps for the place that a frame of status kTracked shows, so that the
  /// maps can be joined, and its own map, if it `is_keyframe`, for parts that it shares no
  /// landmarks with, so that a loop can be closed. Inactive maps are searched in one of their
  /// keyframes in 1/30 s, `seconds` after the frame before (KeyframesToTry). After a success, that
  /// search pauses for SegmentOptions::search_interval, and that for loops for 0.2 s.
  std::optional<Revisit> FindRevisit(const TrackedFrame& tracked, bool is_keyframe,
                                     const MapSnapshot& snapshot, double seconds);

  /// Lists the state for a checkpoint. The index has what the next snapshot has.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, index, newest, keyframes, order, look_alikes,
           last_success] = *this;  // all members, or it does not compile
    archive(order, look_alikes, last_success);
  }

 private:
  // The keyframes that look like a frame, best first.
  std::vector<Place> Rank(const Frame& frame) const { return index_.Query(frame, index_.size()); }
  std::optional<Revisit> FindInInactiveMaps(const TrackedFrame& tracked,
                                            const MapSnapshot& snapshot, double seconds);
  std::optional<Revisit> FindLoop(const TrackedFrame& tracked, const MapSnapshot& snapshot) const;
  // The pose of the frame at another of the `places` of an inactive map, if it could as well be
  // there.
  std::optional<Revisit> FindRival(const TrackedFrame& tracked, const MapSnapshot& snapshot,
                                   const Map& map, const Revisit& found,
                                   const std::vector<Place>& places) const;
  // The pose of the frame by the landmarks around a keyframe of `map`.
  std::optional<Revisit> Relocalize(const TrackedFrame& tracked, const NoiseScale& noise_scale,
                                    const Map& map, const Keyframe& keyframe) const;

  TrackerOptions options_;
  PlaceIndex index_;
  // Of the snapshot that the index was updated to.
  KeyframeId newest_ = kNoId;
  size_t num_keyframes_ = 0;
  TryOrder order_;  // in inactive maps
  LookAlikes look_alikes_;
  double last_success_ = -std::numeric_limits<double>::infinity();  // seconds
};

}  // namespace msc_vo
