// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/plane_map.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/plane_features.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

const Plane kWall({0.0, 0.0, -1.0}, 2.0), kFloor({0.0, -1.0, 0.0}, 1.4);

// Three keyframes that see a wall and the floor.
class PlaneMapTest : public testing::Test {
 protected:
  PlaneMapTest() {
    for (int i = 0; i < 3; ++i) Add({ExpSO3({0.0, 0.1 * i, 0.0}), {0.1 * i, 0.0, 0.05 * i}});
  }
  void Add(const Rigid3& pose) {
    auto frame = std::make_shared<Frame>();
    frame->planes = {FeatureOf(pose * kWall), FeatureOf(pose * kFloor)};
    planes_.AddKeyframe(map_, map_.AddKeyframe(frame, pose), PoseCovariance::Zero());
  }
  // The largest difference of the parameters of the planes from those of wall and floor, moved.
  double Error(const Rigid3& moved) const {
    const MapPlanes found = planes_.InWorld(map_);
    if (found.planes.size() != 2) return std::numeric_limits<double>::infinity();
    return std::max((found.planes[0].plane.params - (moved * kWall).params).norm(),
                    (found.planes[1].plane.params - (moved * kFloor).params).norm());
  }

  Map map_;
  PlaneMap planes_;
};

TEST_F(PlaneMapTest, FindsThePlanesOfOneKeyframeInTheOthers) { EXPECT_LT(Error({}), 1e-9); }

TEST_F(PlaneMapTest, PlanesMoveWithTheMap) {
  const Rigid3 new_from_old(ExpSO3({0.2, 0.1, -0.3}), {1.0, -2.0, 0.5});
  map_.Transform(new_from_old);
  EXPECT_LT(Error(new_from_old), 1e-9);
}

TEST_F(PlaneMapTest, PlanesOutliveTheirFirstKeyframe) {
  map_.RemoveKeyframe(0, 1);
  planes_.Renew(map_);
  EXPECT_LT(Error({}), 1e-9);
}

TEST_F(PlaneMapTest, PlanesThatNoKeyframeObservesAreForgotten) {
  planes_.Renew(Map());
  EXPECT_TRUE(planes_.empty());
}

TEST_F(PlaneMapTest, WindowsTieKeyframesToThePlanesThatTwoObserve) {
  WindowData window;
  for (const auto& [id, keyframe] : map_.keyframes()) {
    window.keyframes.push_back({id, keyframe.cam_from_world});
  }
  planes_.AddTo(map_, &window);
  EXPECT_EQ(window.custom_factors.size(), 6u);
  ASSERT_EQ(window.extra_blocks.size(), 2u);
  for (const ExtraBlock& block : window.extra_blocks) EXPECT_LT(block.id, PlaneMap::kFirstBlock);
  window.keyframes.resize(1);
  window.custom_factors.clear();
  window.extra_blocks.clear();
  planes_.AddTo(map_, &window);
  EXPECT_TRUE(window.custom_factors.empty() && window.extra_blocks.empty());
}

TEST_F(PlaneMapTest, LearnsEstimatesOfWindows) {
  WindowData window;
  for (const auto& [id, keyframe] : map_.keyframes()) {
    window.keyframes.push_back({id, keyframe.cam_from_world});
  }
  planes_.AddTo(map_, &window);
  const Plane estimate(kFloor.normal(), kFloor.offset() + 0.01);
  for (ExtraBlock& block : window.extra_blocks) {
    if (block.value[3] < 1.5) block.value = estimate.params;
  }
  planes_.Learn(map_, window);
  EXPECT_LT((planes_.InWorld(map_).planes[1].plane.params - estimate.params).norm(), 1e-9);
}

TEST_F(PlaneMapTest, FitsPlanesToAllKeyframesThatObserveThem) {
  const Rigid3 pose = map_.FindKeyframe(0)->cam_from_world;
  map_.SetPose(0, pose * Rigid3({1, 0, 0, 0}, {0.0, 0.03, 0.0}));  // of the host
  const double hosted = Error({});
  EXPECT_NEAR(hosted, 0.03, 1e-3);
  planes_ = planes_.Fitted(map_);
  EXPECT_LT(Error({}), 0.5 * hosted);
  map_.SetPose(0, pose);
  EXPECT_GT(Error({}), 0.01);
  planes_ = planes_.Fitted(map_);
  EXPECT_LT(Error({}), 1e-6);
}

TEST_F(PlaneMapTest, PlanesOfOneKeyframeFollowItsFrame) {
  const Plane door({1.0, 0.0, 0.0}, 1.0);
  const Rigid3 pose = map_.FindKeyframe(2)->cam_from_world;
  auto frame = std::make_shared<Frame>();
  frame->planes = {FeatureOf(pose * kWall), FeatureOf(pose * door)};
  const KeyframeId id = map_.AddKeyframe(frame, pose);
  planes_.AddKeyframe(map_, id, PoseCovariance::Zero());
  const auto moved = std::make_shared<Frame>(*frame);
  const Rigid3 turn(ExpSO3({0.0, 0.02, 0.0}), {0.0, 0.0, 0.0});
  for (PlaneFeature& plane : moved->planes) plane.Move(turn);
  map_.SetFrame(id, moved);
  planes_.FollowFrames(map_);
  const MapPlanes found = planes_.InWorld(map_);
  ASSERT_EQ(found.planes.size(), 3u);
  EXPECT_LT((found.planes[0].plane.params - kWall.params).norm(), 1e-9) << "others see it, too";
  const Plane expected = pose.Inverse() * (turn * (pose * door));
  EXPECT_LT((found.planes[2].plane.params - expected.params).norm(), 1e-9);
}

TEST_F(PlaneMapTest, NumbersPlanesAnewWhenTheirIdsChange) {
  const int64_t before = planes_.InWorld(map_).numbering;
  PlaneMap joined = planes_;
  joined.Join(PlaneMap());
  EXPECT_NE(joined.InWorld(map_).numbering, before);
}

// The three keyframes are of an earlier session. The next one sees the wall and a door.
TEST_F(PlaneMapTest, KeepsPlanesOfEarlierSessions) {
  planes_.RemoveKeyframesOfThisRun(map_);
  EXPECT_TRUE(planes_.empty());
  for (KeyframeId id = 0; id < 3; ++id) planes_.AddKeyframe(map_, id, PoseCovariance::Zero());
  map_.BeginSession();
  const Plane door({1.0, 0.0, 0.0}, 1.0);
  const Rigid3 pose = map_.FindKeyframe(2)->cam_from_world;
  auto frame = std::make_shared<Frame>();
  frame->planes = {FeatureOf(pose * kWall), FeatureOf(pose * door)};
  planes_.AddKeyframe(map_, map_.AddKeyframe(frame, pose), PoseCovariance::Zero());
  ASSERT_EQ(planes_.InWorld(map_).planes.size(), 3u);
  planes_.RemoveKeyframesOfThisRun(map_);
  EXPECT_LT(Error({}), 1e-9);
  for (const auto& [plane, count] : planes_.NumObservations()) EXPECT_EQ(count, 3) << plane;
}

// Two features of the last keyframe are parts of one door.
TEST_F(PlaneMapTest, TwoFeaturesOfAKeyframeAreOneObservation) {
  const Plane door({1.0, 0.0, 0.0}, 1.0);
  const Rigid3 pose = map_.FindKeyframe(2)->cam_from_world;
  KeyframeId last = kNoId;
  for (const size_t num_features : {1, 2}) {
    auto frame = std::make_shared<Frame>();
    frame->planes.assign(num_features, FeatureOf(pose * door));
    last = map_.AddKeyframe(frame, pose);
    planes_.AddKeyframe(map_, last, PoseCovariance::Zero());
  }
  ASSERT_EQ(planes_.InWorld(map_).planes.size(), 3u);
  WindowData window;
  window.keyframes.push_back({last, pose});
  planes_.AddTo(map_, &window);
  EXPECT_TRUE(window.custom_factors.empty() && window.extra_blocks.empty());
  window.keyframes.push_back({last - 1, pose});
  planes_.AddTo(map_, &window);
  EXPECT_EQ(window.custom_factors.size(), 3u);
  EXPECT_EQ(window.extra_blocks.size(), 1u);
}

TEST_F(PlaneMapTest, FitsPlanesWhoseHostWasRemoved) {
  map_.RemoveKeyframe(0, 1);
  planes_ = planes_.Fitted(map_);
  EXPECT_LT(Error({}), 1e-6);
}

// A patch of a wall at z = 2 that is seen from its front, between two values of x.
PlaneFeature Patch(const Rigid3& cam_from_world, double min_x, double max_x, double depth = 2.0) {
  PlaneFeature feature = FeatureOf(cam_from_world * Plane({0.0, 0.0, -1.0}, depth));
  for (const double x : {min_x, max_x}) {
    for (const double y : {-0.5, 0.5}) {
      feature.hull.emplace_back((cam_from_world * Eigen::Vector3d(x, y, depth)).hnormalized());
    }
  }
  feature.hull = ConvexHull(feature.hull);
  return feature;
}

class PlaneExtentsTest : public testing::Test {
 protected:
  // A keyframe in front of the given place whose frame has one plane.
  KeyframeId Add(double x, const std::function<PlaneFeature(const Rigid3&)>& feature,
                 const Rigid3& error = {}) {
    const Rigid3 pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-x, 0.0, 0.0));
    auto frame = std::make_shared<Frame>();
    frame->planes = {feature(pose)};
    const KeyframeId id = map_.AddKeyframe(frame, error * pose);
    planes_.AddKeyframe(map_, id, PoseCovariance::Zero());
    return id;
  }
  KeyframeId AddPatch(double min_x, double max_x, const Rigid3& error = {}) {
    return Add(
        0.5 * (min_x + max_x), [&](const Rigid3& pose) { return Patch(pose, min_x, max_x); },
        error);
  }
  std::vector<PlaneLandmark> Planes() const { return planes_.InWorld(map_).planes; }
  static double Width(const PlaneLandmark& plane) {
    double min = 1e9, max = -1e9;
    for (const Eigen::Vector3d& vertex : plane.extent) {
      min = std::min(min, vertex.x());
      max = std::max(max, vertex.x());
    }
    return max - min;
  }
  static Rigid3 Forward(double metres) {
    return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, metres)};
  }

  Map map_;
  PlaneMap planes_;
};

TEST_F(PlaneExtentsTest, GrowByWhatKeyframesShow) {
  AddPatch(-1.0, 0.0);
  ASSERT_EQ(Planes().size(), 1u);
  EXPECT_NEAR(Width(Planes()[0]), 1.0, 1e-9);
  AddPatch(-0.2, 1.3);
  ASSERT_EQ(Planes().size(), 1u);
  EXPECT_NEAR(Width(Planes()[0]), 2.3, 1e-9);
  const PlaneLandmark plane = Planes()[0];
  EXPECT_EQ(plane.extent.size(), 4u);
  for (const Eigen::Vector3d& vertex : plane.extent) EXPECT_NEAR(vertex.z(), 2.0, 1e-9);
}

// A keyframe whose pose is wrong takes a wall for another one. When a better one sees both parts,
// they become one.
TEST_F(PlaneExtentsTest, MergePartsOfOneWall) {
  AddPatch(-1.0, 0.0);
  const KeyframeId wrong = AddPatch(0.1, 1.0, Forward(0.2));
  ASSERT_EQ(Planes().size(), 2u);
  map_.SetPose(wrong, Forward(-0.2) * map_.FindKeyframe(wrong)->cam_from_world);
  AddPatch(-1.0, 0.0);
  ASSERT_EQ(Planes().size(), 1u);
  EXPECT_NEAR(Width(Planes()[0]), 2.0, 1e-9);
  // The keyframes of both observe it.
  const SavedPlanes saved = planes_.Save(map_);
  for (const auto& [id, matches] : saved.observations) EXPECT_EQ(matches[0].plane, Planes()[0].id);
  EXPECT_EQ(saved.observations.size(), 3u);
}

TEST_F(PlaneExtentsTest, KeepPartsApartThatDoNotTouch) {
  AddPatch(-1.0, 0.0);
  const KeyframeId wrong = AddPatch(1.0, 2.0, Forward(0.2));
  map_.SetPose(wrong, Forward(-0.2) * map_.FindKeyframe(wrong)->cam_from_world);
  AddPatch(-1.0, 0.0);
  EXPECT_EQ(Planes().size(), 2u);
}

TEST_F(PlaneExtentsTest, KeepADoorApartFromItsWall) {
  AddPatch(-1.0, 0.0);
  Add(0.5, [](const Rigid3& pose) { return Patch(pose, 0.05, 0.9, 1.9); });
  AddPatch(-1.0, 0.0);
  EXPECT_EQ(Planes().size(), 2u);
}

TEST_F(PlaneExtentsTest, AreSavedWithAHostThatIsInTheMap) {
  AddPatch(-1.0, 0.0);
  AddPatch(-0.2, 1.3);
  const std::vector<PlaneLandmark> before = Planes();
  map_.RemoveKeyframe(0, 1);
  planes_.Renew(map_);
  const SavedPlanes saved = planes_.Save(map_);
  ASSERT_EQ(saved.planes.size(), 1u);
  EXPECT_EQ(saved.planes.begin()->second.host, 1);
  EXPECT_EQ(saved.observations.size(), 1u);
  PlaneMap restored;
  restored.Restore(saved);
  const std::vector<PlaneLandmark> after = restored.InWorld(map_).planes;
  ASSERT_EQ(after.size(), 1u);
  EXPECT_LT((after[0].plane.params - before[0].plane.params).norm(), 1e-9);
  EXPECT_NEAR(Width(after[0]), Width(before[0]), 1e-9);
  // Further planes have other ids.
  planes_ = restored;
  Add(0.0, [](const Rigid3& pose) { return Patch(pose, -0.2, 0.2, 1.0); });
  EXPECT_EQ(Planes().size(), 2u);
}

// A map of this run is joined with one of an earlier session, whose plane becomes part of its own.
TEST_F(PlaneExtentsTest, OfEarlierSessionsDoNotDependOnTheRun) {
  const KeyframeId earlier = AddPatch(-1.0, 0.0);
  PlaneMap other = std::exchange(planes_, PlaneMap());
  map_.BeginSession();
  const KeyframeId own = AddPatch(-0.2, 1.3, Forward(0.02));
  planes_.Join(std::move(other));
  planes_.MergeDuplicates(map_, own);
  ASSERT_EQ(planes_.Save(map_).planes.at(0).host, own);
  ASSERT_NEAR(Width(Planes()[0]), 2.3, 1e-2);
  planes_.RemoveKeyframesOfThisRun(map_);
  EXPECT_EQ(planes_.Save(map_).planes.at(0).host, earlier);
  ASSERT_EQ(Planes().size(), 1u);
  EXPECT_NEAR(Width(Planes()[0]), 1.0, 1e-9);
  EXPECT_LT((Planes()[0].plane.params - Plane({0.0, 0.0, -1.0}, 2.0).params).norm(), 1e-9);
}

TEST_F(PlaneMapTest, JoinsKeepThePlanesOfBothMaps) {
  PlaneMap other;
  auto frame = std::make_shared<Frame>();
  frame->planes = {FeatureOf(kWall)};
  Map other_map = map_.Next();
  const KeyframeId keyframe = other_map.AddKeyframe(frame, {}, 7);
  other.AddKeyframe(other_map, keyframe, PoseCovariance::Zero());
  map_.Merge(other_map);
  planes_.Join(std::move(other));
  EXPECT_EQ(planes_.InWorld(map_).planes.size(), 3u);
}

}  // namespace
}  // namespace msc_vo
