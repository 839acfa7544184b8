// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_joiner.h"

#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

// A camera that looks along z and moves along x.
Rigid3 CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}}; }

KeyframeId AddKeyframe(double timestamp, double x, Map* map) {
  auto frame = std::make_shared<Frame>();
  frame->timestamp = timestamp;
  return map->AddKeyframe(frame, CameraAt(x));
}

// A camera that moves at 0.5 m/s along x is tracked in one map for two seconds, and in another one
// from the fourth second on. Both maps have the same world.
class MapJoinerTest : public testing::Test {
 protected:
  MapJoinerTest() {
    for (const double time : {0.0, 0.5, 1.0}) AddKeyframe(time, 0.5 * time, &atlas_.current().map);
    BeginMap(2.0);
  }

  // Leaves the current map for a new one after a last pose at that time.
  void BeginMap(double seconds) {
    const auto& [id, keyframe] = atlas_.current().map.keyframes().back();
    const double distance = 0.5 * (seconds - keyframe.frame->timestamp);
    joiner_.AddLastPose({seconds, id, CameraAt(distance)});
    atlas_.Begin(true);
    joiner_.Clear();
  }

  // Continues at `seconds` with three keyframes that are found in the older map, `offset` metres
  // away from where they are.
  std::optional<MapJoin> JoinAt(double seconds, double offset) {
    const PoseCovariance covariance = 1e-6 * PoseCovariance::Identity();
    for (int i = 0; i < 3; ++i) {
      const double time = seconds + 0.5 * i;
      const double x = 0.5 * time;
      const KeyframeId keyframe = AddKeyframe(time, x, &atlas_.current().map);
      const KeyframeId reference = 0;  // at x = 0
      joiner_.Add({keyframe, covariance, {reference, CameraAt(x + offset), covariance, {}}});
    }
    return joiner_.TryJoin(&atlas_);
  }

  Atlas atlas_{SceneAxesOptions(), NoiseEstimatorOptions()};
  MapJoiner joiner_;
};

TEST_F(MapJoinerTest, JoinsMapsInWhichKeyframesAgree) {
  const std::optional<MapJoin> join = JoinAt(4.0, 0.0);
  ASSERT_TRUE(join);
  EXPECT_EQ(join->num_keyframes, 3);
  EXPECT_NEAR(join->moved_from_kept.translation().norm(), 0.0, 1e-6);
  EXPECT_TRUE(atlas_.inactive_maps().empty());
  EXPECT_EQ(atlas_.current().map.keyframes().size(), 6u);
}

// The other end of a corridor, which looks alike.
TEST_F(MapJoinerTest, JoinsNoMapsBetweenWhichTheCameraCannotHaveMoved) {
  EXPECT_FALSE(JoinAt(4.0, 10.0));
  EXPECT_EQ(atlas_.inactive_maps().size(), 1u);
  EXPECT_EQ(atlas_.current().map.keyframes().size(), 3u);
}

TEST_F(MapJoinerTest, JoinsDistantPlacesThatTheCameraHadTimeToReach) {
  EXPECT_TRUE(JoinAt(40.0, 10.0));
}

// From the last keyframe on, the camera had a second more: 1.3 m/s, which is possible.
TEST_F(MapJoinerTest, CountsTheTimeFromTheLastPose) { EXPECT_FALSE(JoinAt(4.0, 2.5)); }

TEST_F(MapJoinerTest, ForgetsKeyframesThatAgreeOnAnImpossibleMotion) {
  ASSERT_FALSE(JoinAt(4.0, 10.0));
  EXPECT_EQ(joiner_.num_refused(), 1);
  EXPECT_TRUE(JoinAt(6.0, 0.0));  // three of six would not be more than half
  EXPECT_EQ(joiner_.num_refused(), 1);
}

// Both maps have ten lines and refined axes; those of the current map are rotated about the y axis.
class AxesOfMapsTest : public MapJoinerTest {
 protected:
  static constexpr int kNumLines = 10;

  AxesOfMapsTest() {
    atlas_.ChangeAll([this](SubMap* submap) {
      SetAxes(0.0, 0.2, submap);
      if (submap == &atlas_.current()) return;
      AddLines(kNumLines, Eigen::Matrix3d::Identity(), 100, &submap->map);
    });
  }

  static Eigen::Matrix3d Rotation(double degrees) {
    return Eigen::AngleAxisd(DegreesToRadians(degrees), Eigen::Vector3d::UnitY())
        .toRotationMatrix();
  }
  static void SetAxes(double degrees, double sigma_degrees, SubMap* submap) {
    submap->axes = SceneAxes(SceneAxesOptions());
    submap->axes.Restore(
        {Eigen::Quaterniond(Rotation(degrees)), DegreesToRadians(sigma_degrees), 0.0});
  }
  // Adds lines, the first of which are along an axis, the others at 45 degrees to it.
  static void AddLines(int num_along_axis, const Eigen::Matrix3d& rotation, LandmarkId first,
                       Map* map) {
    for (int i = 0; i < kNumLines; ++i) {
      LineLandmark line;
      line.id = first + i;
      const Eigen::Vector3d direction(1.0, 0.0, i < num_along_axis ? 0.0 : 1.0);
      line.segment = {{0.0, 0.1 * i, 2.0},
                      Eigen::Vector3d(0.0, 0.1 * i, 2.0) + rotation * direction};
      line.direction_sigma = DegreesToRadians(0.5);
      map->AddExisting(line);
    }
  }
  // Whether maps are joined whose axes differ by that angle.
  bool JoinsWithAxes(double degrees, double sigma_degrees, int num_along_axes = kNumLines) {
    SetAxes(degrees, sigma_degrees, &atlas_.current());
    AddLines(num_along_axes, Rotation(degrees), 200, &atlas_.current().map);
    return JoinAt(4.0, 0.0).has_value();
  }
};

TEST_F(AxesOfMapsTest, ExcludeAJoinIfTheyDiffer) {
  EXPECT_FALSE(JoinsWithAxes(10.0, 0.2));
  EXPECT_EQ(joiner_.num_refused(), 1);
}

TEST_F(AxesOfMapsTest, MayDifferWithinTheirSigma) { EXPECT_TRUE(JoinsWithAxes(0.3, 0.2)); }

TEST_F(AxesOfMapsTest, MayBeInterchanged) { EXPECT_TRUE(JoinsWithAxes(90.3, 0.2)); }

// A wing of a building that has axes of its own, beside others.
TEST_F(AxesOfMapsTest, AreIgnoredIfLessThanTwoThirdsOfTheLinesFollowThem) {
  EXPECT_TRUE(JoinsWithAxes(10.0, 0.2, 6));
}

TEST_F(AxesOfMapsTest, CountIfTwoThirdsOfTheLinesFollowThem) {
  EXPECT_FALSE(JoinsWithAxes(10.0, 0.2, 7));
}

TEST_F(AxesOfMapsTest, AreIgnoredWhileTheyAreCoarse) { EXPECT_TRUE(JoinsWithAxes(10.0, 1.0)); }

// The first gap is crossed at 1.4 m/s, the second one at 2.5 m/s. Nobody has seen either motion.
TEST_F(MapJoinerTest, DoesNotLearnSpeedsFromGaps) {
  ASSERT_TRUE(JoinAt(4.0, 1.8));
  BeginMap(6.0);
  EXPECT_FALSE(JoinAt(8.0, 4.0 + 1.8));
}

}  // namespace
}  // namespace msc_vo
