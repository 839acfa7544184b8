// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/frame_view_collector.h"

#include "tests/support/tracked_scene.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// The frames whose views are kept of a run in which every `keyframe_interval`-th frame is a
// keyframe.
std::vector<int> Kept(int num_frames, int keyframe_interval, const FrameViewLimits& limits) {
  TrackedScene scene;
  FrameViewCollector collector(num_frames, {}, limits);
  for (int i = 0; i < num_frames; ++i) {
    scene.result.id = i;
    scene.result.is_keyframe = i % keyframe_interval == 0;
    collector.Add(scene.View());
  }
  std::vector<int> frames;
  size_t bytes = 0;
  for (const FrameView& view : collector.Take()) {
    frames.push_back(view.frame);
    bytes += NumBytes(view);
  }
  EXPECT_LE(bytes, limits.max_bytes);
  EXPECT_TRUE(collector.Take().empty());
  return frames;
}

size_t BytesOfOne() {
  const TrackedScene scene;
  FrameViewCollector collector(1, {}, {});
  collector.Add(scene.View());
  return NumBytes(collector.Take().at(0));
}

TEST(FrameViewCollector, KeepsAllFramesOfAShortRun) {
  EXPECT_THAT(Kept(4, 3, {}), testing::ElementsAre(0, 1, 2, 3));
}

TEST(FrameViewCollector, SpacesTheFramesOfALongRunEvenly) {
  FrameViewLimits limits;
  limits.max_spaced = 5;
  // Every fourth frame, and the keyframes.
  EXPECT_THAT(Kept(20, 7, limits), testing::ElementsAre(0, 4, 7, 8, 12, 14, 16));
}

TEST(FrameViewCollector, ThinsOtherFramesBeforeKeyframes) {
  FrameViewLimits limits;
  limits.max_bytes = 7 * BytesOfOne();
  EXPECT_THAT(Kept(20, 7, limits), testing::ElementsAre(0, 4, 7, 8, 12, 14, 16));
  limits.max_bytes = 4 * BytesOfOne();
  EXPECT_THAT(Kept(20, 7, limits), testing::ElementsAre(0, 7, 14, 16));
}

TEST(FrameViewCollector, ThinsKeyframesIfTheyAreTooMany) {
  FrameViewLimits limits;
  limits.max_bytes = 3 * BytesOfOne();
  EXPECT_THAT(Kept(12, 1, limits), testing::ElementsAre(0, 4, 8));
}

}  // namespace
}  // namespace msc_vo
