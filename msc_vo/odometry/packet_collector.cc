// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/packet_collector.h"

#include <utility>

namespace msc_vo {

void PacketCollector::Add(const TrackedFrame& tracked) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    std::vector<LandmarkId> found;
    for (const auto& match : OfKind<L>(tracked.matches)) found.push_back(match.id);
    packet_.counts.Of<L>().AddFrame(tracked.visible.Of<L>(), std::move(found));
  });
  if (tracked.previous_velocity) packet_.last_velocity = tracked.previous_velocity;
}

KeyframePacket PacketCollector::Take(const TrackedFrame& tracked,
                                     const std::optional<double>& frame_interval) {
  KeyframePacket packet = std::exchange(packet_, {});
  packet_.last_keyframe = tracked.keyframe.id;
  const SegmentStart start = tracked.keyframe.segment_start;
  packet.id = tracked.keyframe.id;
  packet.frame = tracked.frame;
  packet.reference = tracked.reference;
  packet.cam_from_reference = tracked.cam_from_reference;
  packet.begins_map = start == SegmentStart::kAfterLoss || start == SegmentStart::kReplacing;
  packet.keeps_last_map = start != SegmentStart::kReplacing;
  packet.last_tracked = tracked.keyframe.last_tracked;
  packet.matches = tracked.matches;
  packet.covariance = CameraCovariance(tracked.cam_from_world, tracked.pose.covariance);
  packet.revisit = tracked.keyframe.revisit;
  packet.frame_interval = frame_interval;
  return packet;
}

}  // namespace msc_vo
