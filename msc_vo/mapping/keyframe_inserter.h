// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/map_alignment.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/mapping/map_joiner.h"
#include "msc_vo/mapping/mapping_summary.h"

namespace msc_vo {

/// Inserts keyframes into the atlas: begins the submap of a segment, adds the keyframe with its
/// observations, and joins submaps.
class KeyframeInserter {
 public:
  /// The newest keyframe of the current submap; kNoId if it is empty.
  KeyframeId newest() const { return newest_; }

  /// Begins the submap of a new segment (KeyframePacket::begins_map).
  void BeginMap(const KeyframePacket& packet, Atlas* atlas);
  /// Adds the keyframe of a packet to the current submap, with `frame` as its features, and joins
  /// that with an inactive one if enough keyframes have been found in both. Sets keyframe, submap
  /// and join of the summary.
  void Insert(const KeyframePacket& packet, std::shared_ptr<const Frame> frame, Atlas* atlas,
              MappingSummary* summary);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [joiner, newest_keyframe] = *this;  // all members
    archive(joiner, newest_keyframe);
  }

 private:
  MapJoiner joiner_;
  KeyframeId newest_ = kNoId;
};

}  // namespace msc_vo
