// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

#include "msc_vo/tracking/tracker.h"

namespace msc_vo {

// A tracker after frame 0, and the map of that frame. The world is camera 0, so that Truth() is
// relative to it.
class TrackerTest : public ::testing::Test {
 protected:
  void Start(const SyntheticFrames::Options& options) {
    world_ = std::make_unique<SyntheticFrames>(options);
    const std::shared_ptr<const Frame> first = world_->MakeFrame(0);
    const TrackedFrame tracked = tracker_.Track(first, MapSnapshot());
    ASSERT_EQ(tracked.status, TrackingStatus::kTracked);
    ASSERT_TRUE(tracked.keyframe.is_due());
    snapshot_ = MapOfOneKeyframe(first, Rigid3());
  }
  static Rigid3 Truth(int index) {
    return SyntheticFrames::CamFromWorld(index) * SyntheticFrames::CamFromWorld(0).Inverse();
  }
  TrackedFrame Track(int index) { return tracker_.Track(world_->MakeFrame(index), snapshot_); }

  Tracker tracker_{TrackerOptions()};
  std::unique_ptr<SyntheticFrames> world_;
  MapSnapshot snapshot_;
};

}  // namespace msc_vo
