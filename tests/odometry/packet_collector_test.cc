// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/packet_collector.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// A frame that shows point 3, which it is matched with, and line 5.
TrackedFrame MakeFrame() {
  TrackedFrame tracked;
  tracked.frame = std::make_shared<Frame>();
  tracked.visible.points = {3};
  tracked.visible.lines = {5};
  tracked.matches.points = {{0, 3, Eigen::Vector3d::Zero()}};
  return tracked;
}

TEST(PacketCollector, CountsTheLandmarksOfAllFramesSinceTheLastKeyframe) {
  PacketCollector packets;
  TrackedFrame tracked = MakeFrame();
  tracked.previous_velocity = CameraVelocity();
  packets.Add(tracked);
  tracked.previous_velocity.reset();
  packets.Add(tracked);
  tracked.keyframe.id = 7;
  const KeyframePacket packet = packets.Take(tracked, 0.25);
  EXPECT_EQ(packet.id, 7);
  EXPECT_EQ(packet.counts.points.at(3).num_visible, 2);
  EXPECT_EQ(packet.counts.points.at(3).num_found, 2);
  EXPECT_EQ(packet.counts.lines.at(5).num_visible, 2);
  EXPECT_EQ(packet.counts.lines.at(5).num_found, 0);
  EXPECT_TRUE(packet.last_velocity.has_value());
  EXPECT_EQ(packet.frame_interval, 0.25);

  packets.Add(tracked);
  const KeyframePacket next = packets.Take(tracked, std::nullopt);
  EXPECT_EQ(next.counts.points.at(3).num_visible, 1);
  EXPECT_FALSE(next.last_velocity.has_value());
}

TEST(PacketCollector, TellsTheMapperWhichMapsBegin) {
  PacketCollector packets;
  TrackedFrame tracked = MakeFrame();
  const auto packet_of = [&](SegmentStart start) {
    tracked.keyframe.segment_start = start;
    return packets.Take(tracked, std::nullopt);
  };
  for (const SegmentStart start : {SegmentStart::kNone, SegmentStart::kFirst}) {
    EXPECT_FALSE(packet_of(start).begins_map);
  }
  EXPECT_TRUE(packet_of(SegmentStart::kAfterLoss).begins_map);
  EXPECT_TRUE(packet_of(SegmentStart::kAfterLoss).keeps_last_map);
  EXPECT_TRUE(packet_of(SegmentStart::kReplacing).begins_map);
  EXPECT_FALSE(packet_of(SegmentStart::kReplacing).keeps_last_map);
}

}  // namespace
}  // namespace msc_vo
