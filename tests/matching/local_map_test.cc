// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/matching/local_map.h"

#include <cmath>
#include <initializer_list>
#include <memory>

#include <gmock/gmock.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr int kAllKeyframes = 100;
const Eigen::Vector3d kPosition(0.0, 0.0, 2.0);  // metres, world; in front of the first camera
const LineSegment3 kSegment{{0.0, -0.3, 2.0}, {0.0, 0.3, 2.0}};

std::vector<LandmarkId> PointIds(const LocalMap& local) {
  std::vector<LandmarkId> ids;
  for (const PointCandidate& point : local.points) ids.push_back(point.id);
  return ids;
}

std::vector<LandmarkId> LineIds(const LocalMap& local) {
  std::vector<LandmarkId> ids;
  for (const LineCandidate& line : local.lines) ids.push_back(line.id);
  return ids;
}

// A camera at `distance` metres from kPosition, which looks at it from a direction turned by
// `degrees` about the vertical.
Rigid3 LookFrom(double degrees, double distance) {
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(DegreesToRadians(degrees), Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d center = kPosition - distance * (turn * Eigen::Vector3d::UnitZ());
  return Rigid3(turn, center).Inverse();
}

// The covisibility graph is 0 - 1, and 2 alone. Keyframe 0 observes the points shared_ and only_0_,
// keyframe 1 shared_ and only_1_, keyframe 2 only_2_ and line_2_.
class LocalMapTest : public ::testing::Test {
 protected:
  LocalMapTest() {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(2);
    frame->lines.resize(1);
    frame_ = frame;
    for (int i = 0; i < 3; ++i) map_.AddKeyframe(frame_, Rigid3());
    shared_ = map_.Add<PointLandmark>(0, 0, kPosition);
    map_.Observe<PointLandmark>(shared_, 1, 0);
    only_0_ = map_.Add<PointLandmark>(0, 1, kPosition);
    only_1_ = map_.Add<PointLandmark>(1, 1, kPosition);
    only_2_ = map_.Add<PointLandmark>(2, 0, kPosition);
    line_2_ = map_.Add<LineLandmark>(2, 0, kSegment);
  }

  static FrameMatches Matches(std::initializer_list<LandmarkId> points) {
    FrameMatches matches;
    for (const LandmarkId id : points) matches.points.push_back({0, id, kPosition, true});
    return matches;
  }

  LocalMap Select(const FrameMatches& matches, KeyframeId fallback = 2,
                  int max_keyframes = kAllKeyframes) const {
    return SelectLocalMap(map_, *frame_, Rigid3(), matches, fallback, max_keyframes);
  }
  // The landmarks of keyframe 2 from another pose.
  LocalMap SelectFrom(const Rigid3& cam_from_world) const {
    return SelectLocalMap(map_, *frame_, cam_from_world, {}, 2, kAllKeyframes);
  }

  std::shared_ptr<const Frame> frame_;
  Map map_;
  LandmarkId shared_ = kNoId, only_0_ = kNoId, only_1_ = kNoId, only_2_ = kNoId, line_2_ = kNoId;
};

TEST_F(LocalMapTest, SelectsLandmarksOfKeyframesThatObserveTheMatches) {
  const LocalMap local = Select(Matches({shared_, only_0_}));
  EXPECT_EQ(local.reference, 0);  // two of the matches; keyframe 1 observes one
  EXPECT_THAT(PointIds(local), ElementsAre(shared_, only_0_, only_1_));
  EXPECT_THAT(LineIds(local), IsEmpty());
}

TEST_F(LocalMapTest, PrefersTheNewestReferenceOnTies) {
  EXPECT_EQ(Select(Matches({shared_})).reference, 1);
}

TEST_F(LocalMapTest, AddsCovisibleKeyframesOfTheReference) {
  const LocalMap local = Select(Matches({only_0_}));
  EXPECT_EQ(local.reference, 0);
  EXPECT_THAT(PointIds(local), ElementsAre(shared_, only_0_, only_1_));
}

TEST_F(LocalMapTest, CountsMatchedLines) {
  FrameMatches matches;
  matches.lines.push_back({0, line_2_, kSegment, true});
  const LocalMap local = Select(matches, 0);
  EXPECT_EQ(local.reference, 2);
  EXPECT_THAT(PointIds(local), ElementsAre(only_2_));
  EXPECT_THAT(LineIds(local), ElementsAre(line_2_));
}

TEST_F(LocalMapTest, IgnoresOutliersAndMatchesWithoutLandmark) {
  FrameMatches matches = Matches({only_0_, kNoId, only_2_});
  matches.points.back().inlier = false;
  matches.lines.push_back({0, line_2_, kSegment, false});
  EXPECT_THAT(PointIds(Select(matches)), ElementsAre(shared_, only_0_, only_1_));
}

TEST_F(LocalMapTest, SelectsTheNeighbourhoodOfTheFallbackWithoutLandmarks) {
  const LocalMap of_2 = Select(Matches({kNoId}), 2);
  EXPECT_EQ(of_2.reference, 2);
  EXPECT_THAT(PointIds(of_2), ElementsAre(only_2_));
  const LocalMap of_1 = Select({}, 1);
  EXPECT_EQ(of_1.reference, 1);
  EXPECT_THAT(PointIds(of_1), ElementsAre(shared_, only_0_, only_1_));
}

TEST_F(LocalMapTest, LimitsTheNumberOfKeyframes) {
  // Among the observers of the matches ...
  EXPECT_THAT(PointIds(Select(Matches({shared_, only_0_}), 2, 1)), ElementsAre(shared_, only_0_));
  // ... and among the covisible keyframes of the reference.
  EXPECT_THAT(PointIds(Select(Matches({only_1_}), 2, 1)), ElementsAre(shared_, only_1_));
  EXPECT_THAT(PointIds(Select(Matches({only_1_}), 2, 2)), ElementsAre(shared_, only_0_, only_1_));
}

TEST_F(LocalMapTest, RejectsLandmarksObservedFromOtherDirections) {
  for (const double degrees : {-55.0, 0.0, 55.0}) {
    const LocalMap local = SelectFrom(LookFrom(degrees, 2.0));
    EXPECT_THAT(PointIds(local), ElementsAre(only_2_)) << degrees;
    EXPECT_THAT(LineIds(local), ElementsAre(line_2_)) << degrees;
  }
  for (const double degrees : {-65.0, 65.0, 180.0}) {
    const LocalMap local = SelectFrom(LookFrom(degrees, 2.0));
    EXPECT_THAT(PointIds(local), IsEmpty()) << degrees;
    EXPECT_THAT(LineIds(local), IsEmpty()) << degrees;
  }
}

TEST_F(LocalMapTest, PredictsThePyramidLevelFromTheDistance) {
  // The point was observed at level 0 from two metres.
  const auto level = [this](double exponent) {
    const LocalMap local = SelectFrom(LookFrom(0.0, 2.0 * std::pow(kPyramidScale, -exponent)));
    return local.points.empty() ? kNoId : local.points.front().level;
  };
  EXPECT_EQ(level(0.0), 0);
  EXPECT_EQ(level(3.0), 3);
  EXPECT_EQ(level(3.4), 3);
  EXPECT_EQ(level(3.6), 4);
  // A level of tolerance beyond the pyramid, then the scale is not covered.
  EXPECT_EQ(level(8.4), 7);
  EXPECT_EQ(level(8.6), kNoId);
  EXPECT_EQ(level(-1.4), 0);
  EXPECT_EQ(level(-1.6), kNoId);
}

TEST_F(LocalMapTest, CoversTheLevelsOfAKeyframeOfLargerImages) {
  Frame frame = *frame_;
  frame.points[1].level = -3;
  const Rigid3 far = LookFrom(0.0, 2.0 * std::pow(kPyramidScale, 3.4));
  const LocalMap local = SelectLocalMap(map_, frame, far, {}, 2, kAllKeyframes);
  ASSERT_THAT(PointIds(local), ElementsAre(only_2_));
  EXPECT_EQ(local.points.front().level, -3);
  EXPECT_THAT(PointIds(SelectFrom(far)), IsEmpty());
}

TEST_F(LocalMapTest, CoversTheLevelsOfAHigherPyramid) {
  Frame frame = *frame_;
  frame.points[1].level = 11;
  const Rigid3 near = LookFrom(0.0, 2.0 * std::pow(kPyramidScale, -10.0));
  const LocalMap local = SelectLocalMap(map_, frame, near, {}, 2, kAllKeyframes);
  ASSERT_THAT(PointIds(local), ElementsAre(only_2_));
  EXPECT_EQ(local.points.front().level, 10);
  EXPECT_THAT(PointIds(SelectFrom(near)), IsEmpty());
}

TEST_F(LocalMapTest, LevelsDoNotLimitLines) {
  EXPECT_THAT(LineIds(SelectFrom(LookFrom(0.0, 0.35))), ElementsAre(line_2_));
  EXPECT_THAT(LineIds(SelectFrom(LookFrom(0.0, 6.0))), ElementsAre(line_2_));
}

TEST_F(LocalMapTest, RejectsLandmarksOutsideTheImage) {
  // From a viewing angle of 45 degrees, once towards the landmarks and once past them.
  const Rigid3 towards = LookFrom(45.0, 2.0);
  const Rigid3 past = Rigid3(Eigen::Quaterniond::Identity(), -towards.OriginInSource());
  EXPECT_THAT(PointIds(SelectFrom(towards)), ElementsAre(only_2_));
  const LocalMap local = SelectFrom(past);
  EXPECT_THAT(PointIds(local), IsEmpty());
  EXPECT_THAT(LineIds(local), IsEmpty());
}

TEST_F(LocalMapTest, CandidatesHaveTheDataOfTheirLandmarks) {
  auto frame = std::make_shared<Frame>(*frame_);
  frame->points[0].descriptor.fill(0x5a);
  frame->lines[0].descriptor.fill(0xa5);
  const KeyframeId keyframe = map_.AddKeyframe(frame, Rigid3());
  map_.Add<PointLandmark>(keyframe, 0, {0.4, 0.0, 2.0});
  map_.Add<LineLandmark>(keyframe, 0, kSegment);
  const LocalMap local = Select({}, keyframe);
  ASSERT_EQ(local.points.size(), 1u);
  EXPECT_EQ(local.points[0].position, Eigen::Vector3d(0.4, 0.0, 2.0));
  EXPECT_EQ(local.points[0].descriptor, frame->points[0].descriptor);
  EXPECT_TRUE(local.points[0].pixel.isApprox(frame_->camera.Project({0.4, 0.0, 2.0})));
  ASSERT_EQ(local.lines.size(), 1u);
  EXPECT_EQ(local.lines[0].segment.start, kSegment.start);
  EXPECT_EQ(local.lines[0].descriptor, frame->lines[0].descriptor);
  EXPECT_TRUE(local.lines[0].image.end.isApprox(frame_->camera.Project(kSegment.end)));
}

TEST_F(LocalMapTest, VisibleLandmarksAreThoseOfAllKeyframes) {
  const LocalMap visible = SelectVisibleLandmarks(map_, *frame_, Rigid3());
  EXPECT_THAT(PointIds(visible), ElementsAre(shared_, only_0_, only_1_, only_2_));
  EXPECT_THAT(LineIds(visible), ElementsAre(line_2_));
  EXPECT_EQ(visible.reference, kNoId);
}

TEST_F(LocalMapTest, LandmarksBehindOrSeenFromElsewhereAreNotVisible) {
  const Rigid3 away(Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0), Eigen::Vector3d::Zero());
  EXPECT_THAT(PointIds(SelectVisibleLandmarks(map_, *frame_, away)), IsEmpty());
  const LocalMap from_behind = SelectVisibleLandmarks(map_, *frame_, LookFrom(180.0, 2.0));
  EXPECT_THAT(PointIds(from_behind), IsEmpty());
  EXPECT_THAT(LineIds(from_behind), IsEmpty());
}

}  // namespace
}  // namespace msc_vo
