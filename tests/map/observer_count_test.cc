// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/observer_count.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

std::vector<KeyframeId> Keyframes(const std::vector<Map::Covisible>& ranked) {
  std::vector<KeyframeId> ids;
  for (const Map::Covisible& keyframe : ranked) ids.push_back(keyframe.keyframe);
  return ids;
}

// Four keyframes; point i is observed by keyframes 0 to i.
class ObserverCountTest : public ::testing::Test {
 protected:
  ObserverCountTest() {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(4);
    for (int i = 0; i < 4; ++i) map_.AddKeyframe(frame, Rigid3());
    for (int i = 0; i < 4; ++i) {
      points_.push_back(map_.Add<PointLandmark>(0, i, {0, 0, 2}));
      for (int k = 1; k <= i; ++k) map_.Observe<PointLandmark>(points_.back(), k, i);
    }
  }

  Map map_;
  std::vector<LandmarkId> points_;
};

TEST_F(ObserverCountTest, RanksByCountThenNewestFirst) {
  ObserverCount observers(map_);
  EXPECT_TRUE(observers.Ranked().empty());
  observers.Add(*map_.Find<PointLandmark>(points_[2]));
  EXPECT_THAT(Keyframes(observers.Ranked()), ElementsAre(2, 1, 0));
  observers.Add(*map_.Find<PointLandmark>(points_[1]));
  EXPECT_THAT(Keyframes(observers.Ranked()), ElementsAre(1, 0, 2));
  EXPECT_EQ(observers.Ranked().front().num_shared, 2);
}

TEST_F(ObserverCountTest, SupportsRemovedKeyframes) {
  map_.RemoveKeyframe(0, 1);
  map_.RemoveKeyframe(2, 1);
  ObserverCount observers(map_);
  for (const LandmarkId id : {points_[1], points_[2], points_[3]}) {
    observers.Add(*map_.Find<PointLandmark>(id));
  }
  EXPECT_THAT(Keyframes(observers.Ranked()), ElementsAre(1, 3));
  EXPECT_EQ(observers.Ranked().front().num_shared, 3);
}

TEST_F(ObserverCountTest, IsEmptyForAnEmptyMap) {
  EXPECT_TRUE(ObserverCount(Map()).Ranked().empty());
}

}  // namespace
}  // namespace msc_vo
