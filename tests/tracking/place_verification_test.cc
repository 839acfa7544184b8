// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/place_verification.h"

#include <memory>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr KeyframeId kPlace = 100;
constexpr int kMinMatches = 10;

// A camera that is where keyframe kPlace of another map is, and matches all of its landmarks.
class PlaceVerificationTest : public testing::Test {
 protected:
  PlaceVerificationTest() : PlaceVerificationTest(std::make_shared<Frame>()) {}
  explicit PlaceVerificationTest(const std::shared_ptr<const Frame>& frame) {
    own_ = MapOfOneKeyframe(frame, Rigid3());
    tracked_.frame = frame;
    tracked_.reference = 0;
    place_ = MapOfOneKeyframe(frame, Rigid3(), kPlace);
    found_.reference = kPlace;
  }

  static std::shared_ptr<Frame> FrameAtWall(double distance) {
    auto frame = std::make_shared<Frame>();
    const auto w = static_cast<float>(1.0 / distance);
    frame->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {w, w});
    return frame;
  }

  MapSnapshot own_, place_;
  TrackedFrame tracked_;
  Revisit found_;
};

// The first landmarks of the place are on a wall at 2 m, the others in front of it.
class IsCoplanarTest : public PlaceVerificationTest {
 protected:
  void AddLandmarks(int num_on_wall, int num_others, bool is_matched) {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(num_on_wall + num_others);
    const KeyframeId keyframe = place_.map.AddKeyframe(frame, Rigid3());
    for (int i = 0; i < num_on_wall + num_others; ++i) {
      const Eigen::Vector3d on_wall(0.1 * (i % 7) - 0.3, 0.1 * (i / 7 % 5) - 0.2, 2.0);
      const double depth = i < num_on_wall ? 1.0 : 0.4 + 0.005 * i;
      const LandmarkId id = place_.map.Add<PointLandmark>(keyframe, i, depth * on_wall);
      if (is_matched) found_.matches.points.push_back({i, id});
    }
  }
  bool IsCoplanar() const { return msc_vo::IsCoplanar(found_, place_.map, kMinMatches); }
};

TEST_F(IsCoplanarTest, IfTooFewMatchesAreOffThePlane) {
  AddLandmarks(100, kMinMatches - 1, true);
  AddLandmarks(0, 30, false);
  EXPECT_TRUE(IsCoplanar());
}

TEST_F(IsCoplanarTest, NotIfEnoughMatchesAreOffThePlane) {
  AddLandmarks(100, 4 * kMinMatches, true);
  EXPECT_FALSE(IsCoplanar());
}

// A plane through three of few landmarks has few of them off it, wherever they are.
TEST_F(IsCoplanarTest, NotIfAQuarterOfFewMatchesIsOffThePlane) {
  AddLandmarks(12, 4, true);
  AddLandmarks(0, 30, false);
  EXPECT_FALSE(IsCoplanar());
}

TEST_F(IsCoplanarTest, IfMatchesAreCollinear) {
  AddLandmarks(3, 0, true);
  AddLandmarks(0, 30, false);
  EXPECT_TRUE(IsCoplanar());
}

// A floor is all that this map has.
TEST_F(IsCoplanarTest, NotIfTheMapIsOnePlane) {
  AddLandmarks(100, 0, true);
  AddLandmarks(50, kMinMatches - 1, false);
  EXPECT_FALSE(IsCoplanar());
}

TEST_F(IsCoplanarTest, NotWithoutMatches) {
  AddLandmarks(0, 30, false);
  EXPECT_FALSE(IsCoplanar());
}

class ContradictsSurfacesTest : public PlaceVerificationTest {
 protected:
  ContradictsSurfacesTest() : PlaceVerificationTest(FrameAtWall(2.0)) {}
  bool Contradicts() const { return ContradictsSurfaces(tracked_, own_.map, found_, place_.map); }
  // The wall of the place is at a distance of that many metres.
  void MovePlace(double distance) {
    place_ = MapOfOneKeyframe(FrameAtWall(distance), Rigid3(), kPlace);
  }
};

TEST_F(ContradictsSurfacesTest, NotWhereTheWallsAgree) {
  EXPECT_FALSE(Contradicts());
  MovePlace(2.05);
  EXPECT_FALSE(Contradicts());
}

TEST_F(ContradictsSurfacesTest, WhereTheCameraLooksThroughAWall) {
  MovePlace(1.5);
  EXPECT_TRUE(Contradicts());
}

// It may be behind something that was not there before.
TEST_F(ContradictsSurfacesTest, NotWhereTheWallMayBeHidden) {
  MovePlace(3.0);
  EXPECT_FALSE(Contradicts());
}

// Frames with depth in cells of their corner, in which nine and twelve cells of the place can be
// looked through.
TEST_F(ContradictsSurfacesTest, NotByAFewCells) {
  own_ = MapOfOneKeyframe(std::make_shared<Frame>(), Rigid3());
  MovePlace(1.5);
  for (const int num_columns : {4, 5}) {
    auto few = std::make_shared<Frame>();
    few->depth_ranges.cells.resize(DepthRanges::kColumns * DepthRanges::kRows);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < num_columns; ++column) {
        few->depth_ranges.cells[row * DepthRanges::kColumns + column] = {0.5f, 0.5f};
      }
    }
    tracked_.frame = few;
    EXPECT_EQ(Contradicts(), num_columns == 5);
  }
}

TEST_F(ContradictsSurfacesTest, NotWithoutDepth) {
  tracked_.frame = std::make_shared<Frame>();
  own_ = MapOfOneKeyframe(tracked_.frame, Rigid3());
  EXPECT_FALSE(Contradicts());
}

// The frame itself shows the same wall as the place, but a keyframe around it has seen through it.
TEST_F(ContradictsSurfacesTest, ByKeyframesAroundTheFrame) {
  own_ = MapOfOneKeyframe(FrameAtWall(3.0), Rigid3());
  EXPECT_TRUE(Contradicts());
}

// The frame was found a metre behind the keyframe.
TEST_F(ContradictsSurfacesTest, UnlessThePoseExplainsTheDistance) {
  MovePlace(1.0);
  EXPECT_TRUE(Contradicts());
  found_.cam_from_reference = {Eigen::Quaterniond::Identity(), {0.0, 0.0, 1.0}};
  EXPECT_FALSE(Contradicts());
}

}  // namespace
}  // namespace msc_vo
