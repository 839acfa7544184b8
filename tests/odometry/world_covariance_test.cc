// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/world_covariance.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/mapping/keyframe_graph.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {
namespace {

// Ten keyframes 0.25 m apart, on a straight line along x and back to the first one. A loop links
// the last one to it.
class WorldCovarianceTest : public testing::Test {
 protected:
  static constexpr KeyframeId kLast = 9;

  WorldCovarianceTest() {
    const PoseCovariance pose = IsotropicCovariance(2e-4, 2e-4);
    auto snapshot = std::make_shared<MapSnapshot>();
    for (KeyframeId id = 0; id <= kLast; ++id) {
      snapshot->map.AddKeyframe(std::make_shared<Frame>(),
                                CameraAt(0.25 * std::min(id, kLast - id)), id);
      snapshot->map.SetStepCovariance(id, pose);
    }
    snapshot->loops = {{0, kLast, Rigid3(), pose + CommonViewCovariance()}};
    snapshot_ = snapshot;
  }
  static Rigid3 CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}}; }

  // Of a camera in the origin that is tracked relative to a keyframe.
  PoseCovariance RelativeTo(KeyframeId reference) {
    TrackedFrame tracked;
    tracked.reference = reference;
    tracked.pose.covariance = IsotropicCovariance(2e-4, 2e-4);
    FrameResult result;
    result.covariance = tracked.pose.covariance;
    world_covariance_.Set(tracked, snapshot_, &result);
    return *result.world_covariance;  // the camera is in the origin
  }

  MapSnapshotPtr snapshot_;
  WorldCovariance world_covariance_;
};

// After a loop, one frame may share most landmarks with the origin, and the next one with a
// keyframe from the way back. They observe the same landmarks, with the same errors.
TEST_F(WorldCovarianceTest, IsAlikeRelativeToBothEndsOfALoop) {
  const PoseCovariance by_origin = RelativeTo(0), by_last = RelativeTo(kLast);
  for (int i = 0; i < 6; ++i) {
    const double ratio = std::sqrt(by_last(i, i) / by_origin(i, i));
    EXPECT_GT(ratio, 1.0) << i;
    EXPECT_LT(ratio, 2.0) << i;
  }
}

// The map nearby is not exact, even where it is the origin.
TEST_F(WorldCovarianceTest, HasTheErrorsOfLandmarksNearTheOrigin) {
  const PoseCovariance camera = RelativeTo(0);
  for (int i = 0; i < 6; ++i) EXPECT_GT(camera(i, i), CommonViewCovariance()(i, i)) << i;
}

}  // namespace
}  // namespace msc_vo
