// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/tracking_observer.h"

#include <stdexcept>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

class TrackingObserverTest : public RoomTest {};

TEST_F(TrackingObserverTest, SeesEveryFrameWithItsMatchesAndMap) {
  Odometry odometry({}, camera_, {});
  std::vector<FrameResult> seen;
  size_t num_axes = 0;
  odometry.SetTrackingObserver([&](const TrackedImage& image) {
    seen.push_back(image.result);
    EXPECT_EQ(image.image.id, image.result.id);
    EXPECT_EQ(static_cast<int>(image.tracked.matches.points.size()),
              image.result.num_inlier_points);
    if (!image.result.is_keyframe) {
      EXPECT_EQ(image.result.covariance, image.tracked.pose.covariance) << "to the last bit";
    }
    EXPECT_EQ(static_cast<int>(image.features.points.size()), image.result.num_points);
    for (const LineMatch& match : image.tracked.matches.lines) {
      ASSERT_LT(static_cast<size_t>(match.feature), image.features.lines.size());
      EXPECT_NE(image.map.map.Find<LineLandmark>(match.id), nullptr);
    }
    num_axes += image.map.axes ? 1 : 0;
  });
  for (int i = 0; i < kNumFrames; ++i) {
    const FrameResult frame = odometry.Process((*images_)[i]);
    ASSERT_EQ(seen.size(), static_cast<size_t>(i) + 1);
    EXPECT_EQ(seen.back().cam_from_world.params, frame.cam_from_world.params);
    EXPECT_EQ(seen.back().is_keyframe, frame.is_keyframe);
  }
  odometry.Drop(kNumFrames, images_->back().timestamp + 0.1);
  EXPECT_EQ(seen.size(), static_cast<size_t>(kNumFrames));  // nothing was tracked
  EXPECT_NE(odometry.Finish().axes.state, AxesState::kNone);
  EXPECT_GT(num_axes, 0u);
}

TEST_F(TrackingObserverTest, DoesNotChangeTheResult) {
  Odometry plain({}, camera_, {}), observed({}, camera_, {});
  observed.SetTrackingObserver([](const TrackedImage&) {});
  for (const RgbdImage& image : *images_) {
    plain.Process(image);
    observed.Process(image);
  }
  ExpectSameBytes(plain.Finish(), observed.Finish());
}

TEST_F(TrackingObserverTest, ExceptionsReachTheCaller) {
  Odometry odometry({}, camera_, {});
  odometry.SetTrackingObserver([](const TrackedImage&) { throw std::runtime_error("full disk"); });
  EXPECT_THROW(odometry.Process(images_->at(0)), std::runtime_error);
  EXPECT_EQ(odometry.Finish().frames.size(), 1u);
}

}  // namespace
}  // namespace msc_vo
