// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/packet_collector.h"

#include <array>
#include <iterator>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

// The counts of the only landmark that has some.
TrackingCount OnlyCount(const TrackingCounts& counts) {
  EXPECT_EQ(std::distance(counts.begin(), counts.end()), 1);
  return *counts.begin();
}

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
  const TrackingCount point = OnlyCount(packet.counts.points);
  EXPECT_EQ(point.id, 3);
  EXPECT_EQ(point.num_visible, 2);
  EXPECT_EQ(point.num_found, 2);
  const TrackingCount line = OnlyCount(packet.counts.lines);
  EXPECT_EQ(line.id, 5);
  EXPECT_EQ(line.num_visible, 2);
  EXPECT_EQ(line.num_found, 0);
  EXPECT_TRUE(packet.last_velocity.has_value());
  EXPECT_EQ(packet.frame_interval, 0.25);

  packets.Add(tracked);
  const KeyframePacket next = packets.Take(tracked, std::nullopt);
  EXPECT_EQ(OnlyCount(next.counts.points).num_visible, 1);
  EXPECT_FALSE(next.last_velocity.has_value());
  EXPECT_EQ(packet.last_keyframe, kNoId);
  EXPECT_EQ(next.last_keyframe, 7);
}

// The world of the frame may be moved before the mapper inserts the keyframe.
TEST(PacketCollector, GivesTheCovarianceInTheCameraFrame) {
  TrackedFrame tracked = MakeFrame();
  tracked.cam_from_world = Rigid3(ExpSO3({0.1, 0.7, 0.0}), {5.0, 0.0, 2.0});
  const PoseCovariance of_camera = IsotropicCovariance(0.001, 0.01);
  tracked.pose.covariance = CovarianceOfCamera(tracked.cam_from_world, of_camera);
  const KeyframePacket packet = PacketCollector().Take(tracked, std::nullopt);
  EXPECT_LT((packet.covariance - of_camera).norm(), 1e-12);
}

TEST(TrackingCounts, AreMergedById) {
  TrackingCounts counts;
  counts.AddFrame({2, 5, 9}, {});
  counts.AddFrame({1, 5, 7, 12}, {5, 3, 12, 12});  // two fragments of line 12
  std::vector<std::array<int64_t, 3>> found;
  for (const TrackingCount& count : counts) {
    found.push_back({count.id, count.num_visible, count.num_found});
  }
  const std::vector<std::array<int64_t, 3>> expected = {{1, 1, 0}, {2, 1, 0}, {3, 1, 1}, {5, 2, 1},
                                                        {7, 1, 0}, {9, 1, 0}, {12, 1, 1}};
  EXPECT_EQ(found, expected);
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
