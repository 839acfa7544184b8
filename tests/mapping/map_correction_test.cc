// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_correction.h"

#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const LineSegment3 kSegment{{0.0, -0.3, 2.0}, {0.0, 0.3, 2.0}};
const Rigid3 kMotion(ExpSO3({0.1, -0.2, 0.3}), {0.4, 0.5, -0.6});

class MapCorrectionTest : public testing::Test {
 protected:
  MapCorrectionTest() {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(3);
    frame->lines.resize(1);
    for (int i = 0; i < 3; ++i) {
      map_.AddKeyframe(frame, {ExpSO3({0.0, 0.1 * i, 0.0}), {0.2 * i, 0.0, 0.0}});
    }
  }
  // In the camera of a keyframe.
  Eigen::Vector3d Seen(KeyframeId keyframe, LandmarkId point) const {
    return map_.CamFromWorld(keyframe) * map_.Find<PointLandmark>(point)->position;
  }

  Map map_;
};

TEST_F(MapCorrectionTest, LandmarksMoveWithTheirOldestKeyframe) {
  const LandmarkId shared = map_.Add<PointLandmark>(0, 0, {0.1, 0.2, 3.0});
  map_.Observe<PointLandmark>(shared, 1, 0);
  const LandmarkId alone = map_.Add<PointLandmark>(1, 1, {-0.1, 0.3, 4.0});
  const LandmarkId line = map_.Add<LineLandmark>(1, 0, kSegment);
  const Eigen::Vector3d shared_before = map_.Find<PointLandmark>(shared)->position;
  const Eigen::Vector3d alone_before = Seen(1, alone);
  const Eigen::Vector3d start_before = map_.CamFromWorld(1) * kSegment.start;
  const Rigid3 moved = kMotion * map_.CamFromWorld(1);
  MoveKeyframes({{0, map_.CamFromWorld(0)}, {1, moved}}, &map_);
  EXPECT_EQ(map_.CamFromWorld(1).params, moved.params);
  EXPECT_TRUE(map_.Find<PointLandmark>(shared)->position.isApprox(shared_before, 1e-12));
  EXPECT_TRUE(Seen(1, alone).isApprox(alone_before, 1e-12));
  const Eigen::Vector3d start = map_.Find<LineLandmark>(line)->segment.start;
  EXPECT_TRUE((moved * start).isApprox(start_before, 1e-12));
}

TEST_F(MapCorrectionTest, MatchesMakeOneLandmarkOfTwo) {
  const LandmarkId old = map_.Add<PointLandmark>(0, 0, {0.1, 0.2, 3.0});
  const LandmarkId other = map_.Add<PointLandmark>(0, 1, {0.4, 0.2, 3.0});
  const LandmarkId copy = map_.Add<PointLandmark>(1, 2, {0.1, 0.2, 3.01});
  map_.Observe<PointLandmark>(copy, 2, 2);
  FrameMatches matches;
  matches.points.push_back({2, old});    // feature 2 has the copy
  matches.points.push_back({0, other});  // feature 0 has none
  MergeMatches(1, matches, &map_);
  EXPECT_EQ(map_.Find<PointLandmark>(copy), nullptr);
  EXPECT_EQ(map_.Find<PointLandmark>(old)->observations.size(), 3u);  // also in keyframe 2
  EXPECT_NE(FindObservation(*map_.Find<PointLandmark>(other), 1), nullptr);
}

}  // namespace
}  // namespace msc_vo
