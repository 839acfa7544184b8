// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Collects what the mapper is given with a keyframe: the keyframe, and what the frames since the
/// one before it have contributed.
class PacketCollector {
 public:
  /// Adds the landmarks that a frame shows, and its contribution to the keyframe before.
  void Add(const TrackedFrame& tracked);
  /// Returns the packet of a keyframe, which has been added, and begins the next one.
  /// `frame_interval`: seconds since the image before, if there is one.
  KeyframePacket Take(const TrackedFrame& tracked, const std::optional<double>& frame_interval);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(packet_);
  }

 private:
  KeyframePacket packet_;  // the next one, with counts and velocity only
};

}  // namespace msc_vo
