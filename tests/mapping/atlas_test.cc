// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/atlas.h"

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

std::shared_ptr<const Frame> MakeFrame() {
  auto frame = std::make_shared<Frame>();
  frame->points.resize(2);
  frame->lines.resize(1);
  return frame;
}

// Two maps with two keyframes, a point and a line each. The first one is inactive.
class AtlasTest : public testing::Test {
 protected:
  struct Ids {
    KeyframeId first = kNoId, second = kNoId;
    LandmarkId point = kNoId, line = kNoId;
  };

  void SetUp() override {
    old_ = Fill(&atlas_.current().map);
    atlas_.Begin(true);
    new_ = Fill(&atlas_.current().map);
  }

  static Ids Fill(Map* map) {
    Ids ids;
    ids.first = map->AddKeyframe(MakeFrame(), Rigid3());
    ids.second = map->AddKeyframe(MakeFrame(), Rigid3(ExpSO3({0.0, 0.3, 0.0}), {1.0, 0.0, 0.0}));
    ids.point = map->Add<PointLandmark>(ids.first, 0, {0.5, 0.0, 2.0});
    map->Observe<PointLandmark>(ids.point, ids.second, 1);
    ids.line = map->Add<LineLandmark>(ids.first, 0, {{0.0, 0.0, 2.0}, {0.0, 1.0, 3.0}});
    return ids;
  }

  Atlas atlas_{SceneAxesOptions(), NoiseEstimatorOptions()};
  Ids old_, new_;
  const Rigid3 new_from_old_{ExpSO3({0.1, -0.4, 0.9}), {3.0, -2.0, 1.0}};
};

TEST_F(AtlasTest, ContinuesTheIdsInTheNewMap) {
  EXPECT_GT(new_.first, old_.second);
  EXPECT_GT(new_.point, old_.line);
  ASSERT_EQ(atlas_.inactive_maps().size(), 1u);
  EXPECT_EQ(atlas_.FindSubMapOf(old_.first)->id, 0);
  EXPECT_TRUE(atlas_.inactive_maps()[0]->KnowsKeyframe(old_.first));
  EXPECT_EQ(atlas_.FindSubMapOf(new_.second), &atlas_.current());
  EXPECT_EQ(atlas_.Find(1), &atlas_.current());
  EXPECT_EQ(atlas_.FindSubMapOf(99), nullptr);
}

TEST_F(AtlasTest, DiscardsAMapThatIsNotKept) {
  atlas_.Begin(false);
  EXPECT_EQ(atlas_.inactive_maps().size(), 1u);
  EXPECT_TRUE(atlas_.current().map.keyframes().empty());
  EXPECT_EQ(atlas_.FindSubMapOf(new_.first), nullptr);
}

TEST_F(AtlasTest, NumbersItsMapsAsTheSegmentsOfTheRun) {
  EXPECT_EQ(atlas_.current().id, 1);
  atlas_.Begin(false);  // the segment begins again
  EXPECT_EQ(atlas_.current().id, 1);
  Fill(&atlas_.current().map);
  atlas_.Begin(true);
  EXPECT_EQ(atlas_.current().id, 2);
}

TEST_F(AtlasTest, JoinKeepsTheWorldOfTheOlderMap) {
  ASSERT_TRUE(atlas_.Join(old_.second, new_from_old_));
  EXPECT_TRUE(atlas_.inactive_maps().empty());
  EXPECT_EQ(atlas_.current().id, 0);
  const Map& map = atlas_.current().map;
  EXPECT_EQ(map.keyframes().size(), 4u);
  EXPECT_EQ(map.CamFromWorld(old_.first).params, Rigid3().params);
  const Rigid3 old_from_new = new_from_old_.Inverse();
  EXPECT_TRUE(map.CamFromWorld(new_.first).params.isApprox(new_from_old_.params, 1e-12));
  EXPECT_TRUE(map.Find<PointLandmark>(new_.point)
                  ->position.isApprox(old_from_new * Eigen::Vector3d(0.5, 0.0, 2.0), 1e-12));
  EXPECT_TRUE(Eigen::Vector3d(map.Find<LineLandmark>(new_.line)->segment.end)
                  .isApprox(old_from_new * Eigen::Vector3d(0.0, 1.0, 3.0), 1e-12));
  // Landmarks keep their place in the cameras that observe them.
  const Eigen::Vector3d in_cam =
      map.CamFromWorld(new_.second) * map.Find<PointLandmark>(new_.point)->position;
  EXPECT_TRUE(in_cam.isApprox(
      Rigid3(ExpSO3({0.0, 0.3, 0.0}), {1.0, 0.0, 0.0}) * Eigen::Vector3d(0.5, 0.0, 2.0), 1e-12));
}

TEST_F(AtlasTest, JoinMovesAYoungerInactiveMap) {
  atlas_.Begin(true);  // the maps 0 and 1 are inactive
  Fill(&atlas_.current().map);
  ASSERT_TRUE(atlas_.Join(old_.first, Rigid3()));  // 0 and 2
  ASSERT_TRUE(atlas_.Join(new_.first, new_from_old_.Inverse()));
  const Map& map = atlas_.current().map;
  EXPECT_EQ(map.keyframes().size(), 6u);
  EXPECT_EQ(map.CamFromWorld(old_.first).params, Rigid3().params);
  EXPECT_TRUE(map.CamFromWorld(new_.first).params.isApprox(new_from_old_.params, 1e-12));
  EXPECT_FALSE(atlas_.Join(new_.first, Rigid3()));  // it is in the current map already
}

TEST_F(AtlasTest, AJoinedMapCanGrowAndMergeLandmarks) {
  atlas_.Join(old_.first, new_from_old_);
  Map& map = atlas_.current().map;
  map.MergeLandmarks<PointLandmark>(new_.point, old_.point);
  EXPECT_EQ(map.Find<PointLandmark>(old_.point)->observations.size(), 4u);
  EXPECT_EQ(map.FindKeyframe(new_.second)->landmarks.points[1], old_.point);
  map.RemoveKeyframe(new_.first, new_.second);
  EXPECT_TRUE(map.KnowsKeyframe(new_.first));
  const KeyframeId next = map.AddKeyframe(MakeFrame(), Rigid3());
  EXPECT_GT(next, new_.second);
  EXPECT_GT(map.Add<PointLandmark>(next, 0, {0.0, 0.0, 1.0}), new_.line);
}

TEST_F(AtlasTest, SnapshotsDoNotSeeAJoin) {
  const Map before = atlas_.current().map.Share();
  atlas_.Join(old_.first, new_from_old_);
  EXPECT_EQ(before.keyframes().size(), 2u);
  EXPECT_EQ(before.CamFromWorld(new_.first).params, Rigid3().params);
  EXPECT_EQ(before.Find<PointLandmark>(new_.point)->position, Eigen::Vector3d(0.5, 0.0, 2.0));
}

TEST_F(AtlasTest, BeginsWithTheMapsOfEarlierSessions) {
  Atlas next(SceneAxesOptions(), NoiseEstimatorOptions{});
  std::vector<SavedSubMap> saved = atlas_.ShareSubMaps();
  ASSERT_EQ(saved.size(), 2u);
  AxesEstimate axes;
  axes.sigma = 1e-3;
  axes.deviation = 2e-3;
  saved[1].axes = axes;
  saved[1].noise_scale = {0.5, 1.5, 1.0};
  next.BeginWith(std::move(saved));
  EXPECT_EQ(next.current().id, 2);
  ASSERT_EQ(next.inactive_maps().size(), 2u);
  EXPECT_FALSE(next.Find(0)->axes.Estimate());
  EXPECT_TRUE(next.Find(1)->axes.Estimate());
  EXPECT_DOUBLE_EQ(next.Find(1)->noise.scale().line_pixel, 1.5);
  EXPECT_DOUBLE_EQ(next.Find(1)->noise.scale().point_depth, 0.5);
  EXPECT_EQ(next.ShareSubMaps()[1].axes->deviation, 2e-3);
  const Ids ids = Fill(&next.current().map);
  EXPECT_GT(ids.first, new_.second);
  EXPECT_GT(ids.point, new_.line);
  EXPECT_FALSE(next.current().map.IsOfEarlierSession(ids.first));
  // Also after joins, and in further maps.
  ASSERT_TRUE(next.Join(old_.first, Rigid3()));
  EXPECT_EQ(next.current().id, 0);
  EXPECT_TRUE(next.current().map.IsOfEarlierSession(old_.second));
  EXPECT_FALSE(next.current().map.IsOfEarlierSession(ids.first));
  next.Begin(true);
  EXPECT_EQ(next.current().id, 3);
  EXPECT_TRUE(next.current().map.IsOfEarlierSession(new_.second));
  EXPECT_FALSE(next.current().map.IsOfEarlierSession(ids.second));
  EXPECT_EQ(next.ShareSubMaps().size(), 2u);  // those with keyframes
}

}  // namespace
}  // namespace msc_vo
