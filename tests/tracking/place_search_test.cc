// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/place_search.h"

#include "tests/tracking/tracker_fixture.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;

const std::vector<KeyframeId> kRanked{7, 3, 9, 1};  // best first

TEST(TryOrder, SelectsTheBestAndTheOthersInTurn) {
  TryOrder order;
  EXPECT_THAT(order.Select(kRanked, 2), ElementsAre(7, 3));
  EXPECT_THAT(order.Select(kRanked, 2), ElementsAre(7, 9));
  EXPECT_THAT(order.Select(kRanked, 2), ElementsAre(7, 1));
  EXPECT_THAT(order.Select(kRanked, 2), ElementsAre(7, 3));
  order.Reset();
  EXPECT_THAT(order.Select(kRanked, 3), ElementsAre(7, 3, 9));
}

TEST(TryOrder, SelectsTheBestEverySecondTimeIfOneAtATime) {
  TryOrder order;
  std::vector<KeyframeId> selected;
  for (int i = 0; i < 6; ++i) selected.push_back(order.Select(kRanked, 1).at(0));
  EXPECT_THAT(selected, ElementsAre(7, 3, 7, 9, 7, 1));
}

TEST(TryOrder, SelectsNoneTwiceInAFrame) {
  TryOrder order;
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(order.Select(kRanked, 10), testing::UnorderedElementsAreArray(kRanked));
    EXPECT_THAT(order.Select({4}, 10), ElementsAre(4));
    EXPECT_THAT(order.Select({4}, 1), ElementsAre(4));
    EXPECT_THAT(order.Select({}, 10), testing::IsEmpty());
  }
}

using PlaceSearchTest = TrackerTest;

TEST_F(PlaceSearchTest, FindsFramesInAnInactiveMap) {
  Start({});
  // The same scene as an inactive map in another world.
  const Rigid3 other_from_world(
      Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY())), {4.0, 0.0, -1.0});
  const Rigid3 first_from_other = other_from_world.Inverse();
  constexpr KeyframeId kOther = 100;
  MapSnapshot inactive = MapOfOneKeyframe(world_->MakeFrame(0), first_from_other, kOther);
  snapshot_.inactive_maps.push_back(std::make_shared<const Map>(std::move(inactive.map)));
  std::vector<int> found;
  for (int i = 1; i < 20; ++i) {
    const TrackedFrame tracked = Track(i);
    if (!tracked.keyframe.revisit) continue;
    found.push_back(i);
    EXPECT_TRUE(tracked.keyframe.is_due());
    EXPECT_EQ(tracked.keyframe.revisit->reference, kOther);
    // The only keyframe there is camera 0.
    EXPECT_LT(PositionError(tracked.keyframe.revisit->cam_from_reference, Truth(i)), 0.01) << i;
    EXPECT_GT(tracked.keyframe.revisit->matches.points.size(), 50u);
  }
  // Every second one at 30 Hz: a pose in that map needs three.
  ASSERT_GE(found.size(), 3u);
  for (size_t i = 1; i < found.size(); ++i) EXPECT_GE(found[i] - found[i - 1], 2);
  EXPECT_EQ(found[2] - found[0], 4);
}

// Two keyframes of an inactive map show the same place. While they do not lead to a join, one must
// not keep the search from the other.
TEST_F(PlaceSearchTest, SearchesOtherKeyframesOfAnInactiveMap) {
  Start({});
  MapSnapshot inactive = MapOfOneKeyframe(world_->MakeFrame(0), Rigid3(), 100);
  AddKeyframe(world_->MakeFrame(0), Rigid3(), &inactive);
  snapshot_.inactive_maps.push_back(std::make_shared<const Map>(std::move(inactive.map)));
  std::vector<KeyframeId> found;
  for (int i = 1; i < 70 && found.size() < 8; ++i) {
    const TrackedFrame tracked = Track(i);
    if (tracked.keyframe.revisit) found.push_back(tracked.keyframe.revisit->reference);
  }
  EXPECT_THAT(found, testing::IsSupersetOf({100, 100, 100, 101, 101, 101}));
}

// Two rooms that look alike: nothing tells in which of them the camera is.
TEST_F(PlaceSearchTest, DoesNotChooseBetweenPlacesOfAnInactiveMapThatLookAlike) {
  Start({});
  MapSnapshot inactive = MapOfOneKeyframe(world_->MakeFrame(0), Rigid3(), 100);
  AddKeyframe(world_->MakeFrame(0), {Eigen::Quaterniond::Identity(), {4.0, 0.0, 0.0}}, &inactive);
  snapshot_.inactive_maps.push_back(std::make_shared<const Map>(std::move(inactive.map)));
  for (int i = 1; i < 40; ++i) EXPECT_FALSE(Track(i).keyframe.revisit) << i;
}

// A frame whose depth image shows a wall.
std::shared_ptr<const Frame> WithWall(const Frame& frame, double distance) {
  auto result = std::make_shared<Frame>(frame);
  const auto w = static_cast<float>(1.0 / distance);
  result->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {w, w});
  return result;
}

// The frames see a wall at 3 m. A nearer wall of the map would occlude it, a farther one would not.
TEST_F(PlaceSearchTest, FindsNoPlaceWhoseSurfacesTheCameraLooksThrough) {
  Start({});
  for (const double distance : {1.0, 5.0}) {
    MapSnapshot inactive =
        MapOfOneKeyframe(WithWall(*world_->MakeFrame(0), distance), Rigid3(), 100);
    snapshot_.inactive_maps = {std::make_shared<const Map>(std::move(inactive.map))};
    bool is_found = false;
    for (int i = 1; i < 20; ++i) {
      const std::shared_ptr<const Frame> frame = WithWall(*world_->MakeFrame(i), 3.0);
      is_found = is_found || tracker_.Track(frame, snapshot_).keyframe.revisit.has_value();
    }
    EXPECT_EQ(is_found, distance > 3.0) << distance;
  }
}

// All that the frames match is on one wall, of a map that has more: in a map of an earlier session
// it may be any copy of the wall.
TEST_F(PlaceSearchTest, FindsNoPlaceOfAnEarlierSessionByOnePlaneAlone) {
  SyntheticFrames::Options wall;
  wall.num_lines = 0;
  wall.min_depth = wall.max_depth = 4.0;
  Start(wall);
  for (const bool is_earlier : {true, false}) {
    MapSnapshot inactive = MapOfOneKeyframe(world_->MakeFrame(0), Rigid3(), 100);
    SyntheticFrames::Options elsewhere;
    elsewhere.seed = 2;
    AddKeyframe(SyntheticFrames(elsewhere).MakeFrame(0),
                {Eigen::Quaterniond::Identity(), {20.0, 0.0, 0.0}}, &inactive);
    if (is_earlier) inactive.map.BeginSession();
    snapshot_.inactive_maps = {std::make_shared<const Map>(std::move(inactive.map))};
    bool is_found = false;
    for (int i = 1; i < 20; ++i) is_found = is_found || Track(i).keyframe.revisit.has_value();
    EXPECT_NE(is_found, is_earlier);
  }
}

// Two keyframes of the map show the same place and share no landmarks: a loop.
class RevisitTest : public TrackerTest {
 protected:
  static constexpr KeyframeId kNewest = 100;  // no keyframe that the tracker proposes
  // The first keyframe is the older visit, and sees a wall. `from_newest`: where the map has it.
  void StartWithLoop(const Rigid3& from_newest, double wall = 5.0) {
    Start({});
    snapshot_ = MapOfOneKeyframe(WithWall(*world_->MakeFrame(0), wall), from_newest, 0);
    AddKeyframe(world_->MakeFrame(0), Rigid3(), &snapshot_, kNewest);
    PoseCovariance step = PoseCovariance::Zero();
    step.diagonal().head<3>().setConstant(1e-6);
    step.diagonal().tail<3>().setConstant(1e-4);  // 1 cm
    snapshot_.map.SetStepCovariance(kNewest, step);
  }
  // The revisits of frames, which are tracked in the newest keyframe and see a wall at 3 m.
  std::vector<Revisit> FindRevisits() {
    std::vector<Revisit> revisits;
    int last = -6;
    for (int i = 1; i < 40; ++i) {
      const std::shared_ptr<const Frame> frame = WithWall(*world_->MakeFrame(i), 3.0);
      const TrackedFrame tracked = tracker_.Track(frame, snapshot_);
      EXPECT_EQ(tracked.status, TrackingStatus::kTracked) << i;
      if (!tracked.keyframe.revisit) continue;
      revisits.push_back(*tracked.keyframe.revisit);
      EXPECT_GE(i - last, 6) << i;  // 0.2 seconds
      last = i;
      EXPECT_TRUE(tracked.keyframe.is_due());
      EXPECT_LT(PositionError(revisits.back().cam_from_reference, Truth(i)), 0.01) << i;
    }
    return revisits;
  }
};

TEST_F(RevisitTest, IsFoundWhereDriftHasMovedTheMap) {
  StartWithLoop({Eigen::Quaterniond::Identity(), {0.02, 0.0, 0.01}});
  const std::vector<Revisit> revisits = FindRevisits();
  ASSERT_FALSE(revisits.empty());
  for (const Revisit& revisit : revisits) EXPECT_EQ(revisit.reference, 0);
}

TEST_F(RevisitTest, IsNotFoundWhereTheCameraLooksThroughASurface) {
  StartWithLoop({Eigen::Quaterniond::Identity(), {0.02, 0.0, 0.01}}, 1.0);
  EXPECT_TRUE(FindRevisits().empty());
}

// A place that looks alike.
TEST_F(RevisitTest, IsNotFoundFartherAwayThanDriftCanBe) {
  StartWithLoop({Eigen::Quaterniond::Identity(), {0.3, 0.0, 0.0}});
  EXPECT_TRUE(FindRevisits().empty());
}

TEST_F(RevisitTest, IsNotFoundAmongKeyframesThatShareLandmarks) {
  StartWithLoop({});
  const Keyframe& newest = *snapshot_.map.FindKeyframe(kNewest);
  const LandmarkId shared = SlotsOf<PointLandmark>(newest)[0];
  const Keyframe& oldest = *snapshot_.map.FindKeyframe(0);
  const LandmarkId duplicate = SlotsOf<PointLandmark>(oldest)[0];
  ASSERT_NE(shared, kNoId);
  ASSERT_NE(duplicate, kNoId);
  snapshot_.map.MergeLandmarks<PointLandmark>(duplicate, shared);
  EXPECT_TRUE(FindRevisits().empty());
}

}  // namespace
}  // namespace msc_vo
