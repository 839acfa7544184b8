// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/culling.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class CullingTest : public ::testing::Test {
 protected:
  KeyframeId AddKeyframe() {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(4);
    frame->lines.resize(1);
    return map_.AddKeyframe(frame, Rigid3());
  }
  void ObserveAllPoints(KeyframeId keyframe) {
    for (int i = 0; i < 4; ++i) map_.Observe<PointLandmark>(points_[i], keyframe, i);
  }
  void SetUp() override {
    const KeyframeId first = AddKeyframe();
    for (int i = 0; i < 4; ++i)
      points_.push_back(map_.Add<PointLandmark>(first, i, {0.1 * i, 0, 2}));
  }

  Map map_;
  std::vector<LandmarkId> points_;
  CullingOptions options_;
};

TEST_F(CullingTest, RemovesUnconfirmedLandmarksAfterProbation) {
  Probation probation;
  probation.points.insert(points_.begin(), points_.end());
  const KeyframeId second = AddKeyframe();
  map_.Observe<PointLandmark>(points_[0], second, 0);
  CullLandmarks(options_, second, &probation, &map_);
  EXPECT_EQ(map_.points().size(), 4u);  // still on probation
  const KeyframeId third = AddKeyframe();
  CullLandmarks(options_, third, &probation, &map_);
  EXPECT_EQ(map_.points().size(), 1u);
  EXPECT_NE(map_.Find<PointLandmark>(points_[0]), nullptr);
  EXPECT_TRUE(probation.points.empty());
}

TEST_F(CullingTest, RemovesLandmarksThatAreRarelyFound) {
  Probation probation;
  probation.points.insert(points_.begin(), points_.end());
  map_.CountTracking<PointLandmark>(points_[1], 20, 1);
  CullLandmarks(options_, 0, &probation, &map_);
  EXPECT_EQ(map_.Find<PointLandmark>(points_[1]), nullptr);
  EXPECT_EQ(map_.points().size(), 3u);
}

TEST_F(CullingTest, RemovesRedundantKeyframesExceptTheEnds) {
  for (int i = 1; i <= 5; ++i) ObserveAllPoints(AddKeyframe());
  EXPECT_GT(CullKeyframes(options_, 5, &map_), 0);
  EXPECT_NE(map_.FindKeyframe(0), nullptr);
  EXPECT_NE(map_.FindKeyframe(4), nullptr);
  EXPECT_NE(map_.FindKeyframe(5), nullptr);
  // Three observers of every landmark remain, which made the others redundant.
  EXPECT_EQ(map_.keyframes().size(), 3u);
}

// No keyframe has the id 5: its insertion failed.
TEST_F(CullingTest, KeepsThePredecessorWhateverItsId) {
  for (int i = 1; i <= 4; ++i) ObserveAllPoints(AddKeyframe());
  auto frame = std::make_shared<Frame>();
  frame->points.resize(4);
  ObserveAllPoints(map_.AddKeyframe(frame, Rigid3(), 6));
  EXPECT_GT(CullKeyframes(options_, 6, &map_), 0);
  EXPECT_NE(map_.FindKeyframe(4), nullptr);
}

TEST_F(CullingTest, KeepsKeyframesWithFewObservedLandmarks) {
  for (int i = 1; i <= 5; ++i) AddKeyframe();
  map_.Observe<PointLandmark>(points_[0], 2, 0);
  map_.Observe<PointLandmark>(points_[0], 5, 0);
  EXPECT_EQ(CullKeyframes(options_, 5, &map_), 0);
}

}  // namespace
}  // namespace msc_vo
