// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map.h"

#include <gmock/gmock.h>

#include "msc_vo/map/map_renumbering.h"
#include "msc_vo/map/map_validation.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

// A frame whose points have different descriptors.
std::shared_ptr<const Frame> MakeFrame(int num_points, int num_lines) {
  auto frame = std::make_shared<Frame>();
  frame->points.resize(num_points);
  frame->lines.resize(num_lines);
  for (int i = 0; i < num_points; ++i) frame->points[i].descriptor[0] = static_cast<uint8_t>(i);
  return frame;
}

class MapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d translation(-0.5 * i, 0, 0);  // camera i at x = 0.5 i
      keyframes_[i] =
          map_.AddKeyframe(MakeFrame(4, 2), Rigid3(Eigen::Quaterniond::Identity(), translation));
    }
    a_ = map_.Add<PointLandmark>(keyframes_[0], 0, {0, 0, 2});
    b_ = map_.Add<PointLandmark>(keyframes_[1], 1, {0.1, 0, 2});
    LineSegment3 segment;
    segment.start = {0, 0, 2};
    segment.end = {0, 1, 2};
    line_ = map_.Add<LineLandmark>(keyframes_[0], 0, segment);
  }

  Map map_;
  KeyframeId keyframes_[3];
  LandmarkId a_ = kNoId;
  LandmarkId b_ = kNoId;
  LandmarkId line_ = kNoId;
};

TEST_F(MapTest, TakesTheIdOfAKeyframeUnlessItIsNotNew) {
  const KeyframeId id = keyframes_[2] + 5;
  EXPECT_EQ(map_.AddKeyframe(MakeFrame(1, 0), Rigid3(), id), id);
  EXPECT_FALSE(map_.KnowsKeyframe(id - 1));
  EXPECT_EQ(map_.AddKeyframe(MakeFrame(1, 0), Rigid3()), id + 1);
  EXPECT_EQ(map_.Next().AddKeyframe(MakeFrame(1, 0), Rigid3()), id + 2);
  for (const KeyframeId known : {keyframes_[1], id - 1, id + 1}) {
    EXPECT_THROW(map_.AddKeyframe(MakeFrame(1, 0), Rigid3(), known), std::invalid_argument);
  }
}

TEST_F(MapTest, IsRenumberedAfterAnother) {
  MapContents first, second;
  first.sessions = {{0, "first"}};
  first.submaps.push_back({0, map_.Share(), {}, {}});
  second.sessions = {{0, "second"}};
  map_.SetStepCovariance(keyframes_[1], 3.0 * PoseCovariance::Identity());
  second.submaps.push_back({0, map_.Share(), {}, {}});
  second.loops.push_back({keyframes_[0], keyframes_[2], Rigid3(), PoseCovariance::Identity()});
  second.submaps[0].planes.planes[5].host = keyframes_[1];
  second.submaps[0].planes.observations[keyframes_[1]] = {{0, 5}};
  RenumberAfter(first, &second);
  EXPECT_EQ(second.sessions[0].first_keyframe, map_.next_keyframe());
  EXPECT_EQ(second.submaps[0].id, 1);
  const Map& map = second.submaps[0].map;
  EXPECT_EQ(FirstViolation(map), "");
  ASSERT_EQ(map.keyframes().size(), 3u);
  const KeyframeId second_keyframe = map_.next_keyframe() + keyframes_[1];
  EXPECT_EQ(map.CamFromWorld(second_keyframe).params, map_.CamFromWorld(keyframes_[1]).params);
  EXPECT_EQ((*map.StepCovariance(second_keyframe))(0, 0), 3.0);
  const PointLandmark* b = map.Find<PointLandmark>(map_.next_landmark() + b_);
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(b->first_keyframe, second_keyframe);
  ASSERT_EQ(b->observations.size(), 1u);
  EXPECT_EQ(b->observations[0].keyframe, second_keyframe);
  EXPECT_EQ(map.FindKeyframe(second_keyframe)->landmarks.points[1], b->id);
  EXPECT_NE(map.Find<LineLandmark>(map_.next_landmark() + line_), nullptr);
  EXPECT_EQ(second.loops[0].to, map_.next_keyframe() + keyframes_[2]);
  const SavedPlanes& planes = second.submaps[0].planes;
  EXPECT_EQ(planes.planes.at(5).host, second_keyframe);
  ASSERT_EQ(planes.observations.size(), 1u);
  EXPECT_EQ(planes.observations.at(second_keyframe)[0].plane, 5);
}

TEST_F(MapTest, StoresObservationsInLandmarkAndKeyframe) {
  EXPECT_TRUE(map_.Observe<PointLandmark>(a_, keyframes_[2], 3));
  EXPECT_EQ(map_.FindKeyframe(keyframes_[2])->landmarks.points[3], a_);
  ASSERT_EQ(map_.Find<PointLandmark>(a_)->observations.size(), 2u);
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->observations[1].keyframe, keyframes_[2]);
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->observations[1].feature, 3);
}

TEST_F(MapTest, SortsObservationsByKeyframe) {
  EXPECT_TRUE(map_.Observe<PointLandmark>(b_, keyframes_[2], 0));
  EXPECT_TRUE(map_.Observe<PointLandmark>(b_, keyframes_[0], 2));
  std::vector<KeyframeId> order;
  for (const Observation& o : map_.Find<PointLandmark>(b_)->observations)
    order.push_back(o.keyframe);
  EXPECT_THAT(order, ElementsAre(keyframes_[0], keyframes_[1], keyframes_[2]));
}

TEST_F(MapTest, RejectsDuplicateTakenAndUnknownObservations) {
  EXPECT_FALSE(map_.Observe<PointLandmark>(a_, keyframes_[0], 3));  // already observed
  EXPECT_FALSE(map_.Observe<PointLandmark>(a_, keyframes_[1], 1));  // feature of b
  EXPECT_FALSE(map_.Observe<PointLandmark>(999, keyframes_[0], 3));
  EXPECT_FALSE(map_.Observe<LineLandmark>(line_, keyframes_[0], 1));
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->observations.size(), 1u);
}

TEST_F(MapTest, RemovesTheLandmarkWithItsLastObservation) {
  map_.RemoveObservation<PointLandmark>(a_, keyframes_[1]);  // not observed there: no effect
  EXPECT_NE(map_.Find<PointLandmark>(a_), nullptr);
  map_.RemoveObservation<PointLandmark>(a_, keyframes_[0]);
  EXPECT_EQ(map_.Find<PointLandmark>(a_), nullptr);
  EXPECT_EQ(map_.FindKeyframe(keyframes_[0])->landmarks.points[0], kNoId);
}

TEST_F(MapTest, MergesObservationsWithoutCollision) {
  map_.Observe<PointLandmark>(a_, keyframes_[2], 0);
  map_.Observe<PointLandmark>(b_, keyframes_[2], 1);  // both observed in keyframe 2: one remains
  map_.SetHasFalseDepth<PointLandmark>(b_, true);
  map_.MergeLandmarks<PointLandmark>(b_, a_);
  EXPECT_EQ(map_.Find<PointLandmark>(b_), nullptr);
  EXPECT_TRUE(map_.Find<PointLandmark>(a_)->has_false_depth);
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->observations.size(), 3u);
  EXPECT_EQ(map_.FindKeyframe(keyframes_[1])->landmarks.points[1], a_);
  EXPECT_EQ(map_.FindKeyframe(keyframes_[2])->landmarks.points[0], a_);
  EXPECT_EQ(map_.FindKeyframe(keyframes_[2])->landmarks.points[1], kNoId);
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->num_found, 2);
}

TEST_F(MapTest, KeepsThePoseOfARemovedKeyframeRelativeToItsSuccessor) {
  const Rigid3 before = map_.CamFromWorld(keyframes_[1]);
  map_.Observe<PointLandmark>(b_, keyframes_[2], 0);
  map_.RemoveKeyframe(keyframes_[1], keyframes_[2]);
  EXPECT_EQ(map_.FindKeyframe(keyframes_[1]), nullptr);
  EXPECT_EQ(map_.Find<PointLandmark>(b_)->observations.size(), 1u);
  EXPECT_TRUE(map_.CamFromWorld(keyframes_[1]).params.isApprox(before.params, 1e-12));
  // The pose moves with the successor, also after its removal.
  const Rigid3 shift(Eigen::Quaterniond::Identity(), {0, 0, 1});
  map_.RemoveKeyframe(keyframes_[2], keyframes_[0]);
  map_.SetPose(keyframes_[0], shift * map_.CamFromWorld(keyframes_[0]));
  EXPECT_TRUE(map_.CamFromWorld(keyframes_[1]).params.isApprox((shift * before).params, 1e-12));
}

TEST_F(MapTest, RanksCovisibleKeyframesBySharedLandmarks) {
  map_.Observe<PointLandmark>(a_, keyframes_[1], 0);
  map_.Observe<LineLandmark>(line_, keyframes_[1], 0);
  map_.Observe<PointLandmark>(a_, keyframes_[2], 0);
  const std::vector<Map::Covisible> covisible = map_.FindCovisible(keyframes_[0]);
  ASSERT_EQ(covisible.size(), 2u);
  EXPECT_EQ(covisible[0].keyframe, keyframes_[1]);
  EXPECT_EQ(covisible[0].num_shared, 2);
  EXPECT_EQ(covisible[1].keyframe, keyframes_[2]);
  EXPECT_EQ(covisible[1].num_shared, 1);
}

TEST_F(MapTest, RefreshComputesTheCentralDescriptorAndMeanDirection) {
  map_.Observe<PointLandmark>(a_, keyframes_[1], 3);  // descriptor 0b11, nearest to both others
  map_.Observe<PointLandmark>(a_, keyframes_[2], 2);  // descriptor 0b10
  map_.Refresh<PointLandmark>(a_);
  const PointLandmark& point = *map_.Find<PointLandmark>(a_);
  EXPECT_EQ(point.descriptor[0], 0b10);
  const Eigen::Vector3d expected =
      (Eigen::Vector3d(0, 0, 2).normalized() + Eigen::Vector3d(-0.5, 0, 2).normalized() +
       Eigen::Vector3d(-1, 0, 2).normalized())
          .normalized();
  EXPECT_TRUE(point.viewing_direction.isApprox(expected, 1e-12));
}

TEST_F(MapTest, RefreshUpdatesTheDescriptorWithTheObservations) {
  const Descriptor first = map_.Find<PointLandmark>(a_)->descriptor;
  map_.Observe<PointLandmark>(a_, keyframes_[1], 3);
  map_.Observe<PointLandmark>(a_, keyframes_[2], 2);
  map_.Refresh<PointLandmark>(a_);
  EXPECT_NE(map_.Find<PointLandmark>(a_)->descriptor, first);
  map_.RemoveObservation<PointLandmark>(a_, keyframes_[1]);
  map_.RemoveObservation<PointLandmark>(a_, keyframes_[2]);
  map_.Refresh<PointLandmark>(a_);
  EXPECT_EQ(map_.Find<PointLandmark>(a_)->descriptor, first);
}

TEST_F(MapTest, SharedMapsChangeIndependently) {
  Map copy = map_.Share();
  map_.Remove<PointLandmark>(a_);
  map_.SetPose(keyframes_[1], Rigid3());
  EXPECT_NE(copy.Find<PointLandmark>(a_), nullptr);
  EXPECT_DOUBLE_EQ(copy.FindKeyframe(keyframes_[1])->cam_from_world.translation().x(), -0.5);
  copy.Remove<LineLandmark>(line_);
  EXPECT_NE(map_.Find<LineLandmark>(line_), nullptr);
}

}  // namespace
}  // namespace msc_vo
