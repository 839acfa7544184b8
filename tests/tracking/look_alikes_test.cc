// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/look_alikes.h"

#include <cmath>
#include <memory>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

constexpr KeyframeId kFoundPlace = 100;  // where the frame is found

Rigid3 Shift(double x) { return {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}}; }

// A frame that looks like the first keyframe of an inactive map, which may contain other places to
// the left and to the right.
class LookAlikesTest : public ::testing::Test {
 protected:
  LookAlikesTest() {
    snapshot_ = MapOfOneKeyframe(world_.MakeFrame(0), Rigid3());
    tracked_.frame = WithFarBackground(world_.MakeFrame(1));
    tracked_.status = TrackingStatus::kTracked;
    tracked_.reference = 0;
    tracked_.cam_from_reference =
        SyntheticFrames::CamFromWorld(1) * SyntheticFrames::CamFromWorld(0).Inverse();
    tracked_.cam_from_world = tracked_.cam_from_reference;
    inactive_ = MapOfOneKeyframe(world_.MakeFrame(0), Rigid3(), kFoundPlace);
    found_ = FoundAt(0.0);
  }

  // Depth ranges of a surface behind all features: the frame sees all that is in its image.
  static std::shared_ptr<const Frame> WithFarBackground(const std::shared_ptr<const Frame>& frame) {
    auto changed = std::make_shared<Frame>(*frame);
    changed->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {0.02f, 0.02f});
    return changed;
  }
  // The frame at a place that lies `x` metres to the right of kFoundPlace.
  Revisit FoundAt(double x) const {
    Revisit revisit;
    revisit.reference = kFoundPlace;
    revisit.cam_from_reference = tracked_.cam_from_world * Shift(-x);
    return revisit;
  }
  void AddPlace(SyntheticFrames* world, double x) {
    AddKeyframe(world->MakeFrame(0), Shift(-x), &inactive_);
  }
  // Whether the frame is certain where it was found, if it had been taken for `x` before.
  bool AreExcluded(double x) {
    look_alikes_.Add(tracked_, snapshot_, inactive_.map, FoundAt(x));
    return look_alikes_.AreExcluded({}, tracked_, snapshot_, inactive_.map, found_);
  }

  SyntheticFrames world_{{}};
  SyntheticFrames other_world_{[] {
    SyntheticFrames::Options options;
    options.seed = 2;
    return options;
  }()};
  MapSnapshot snapshot_, inactive_;
  TrackedFrame tracked_;
  Revisit found_;
  LookAlikes look_alikes_;
};

TEST_F(LookAlikesTest, DoNotExcludeThePlaceItself) {
  EXPECT_TRUE(look_alikes_.AreExcluded({}, tracked_, snapshot_, inactive_.map, found_));
  EXPECT_TRUE(AreExcluded(0.0));
  EXPECT_TRUE(AreExcluded(0.005));  // up to drift
}

TEST_F(LookAlikesTest, RemainPossibleWhereTheMapShowsTheSame) {
  AddPlace(&world_, 20.0);
  EXPECT_FALSE(AreExcluded(20.0));
}

// The map has the landmarks of the found place five times, those of its copy once. A copy on the
// other side is excluded.
TEST_F(LookAlikesTest, RemainPossibleWhereTheMapShowsTheSameLessOften) {
  for (int visit = 0; visit < 4; ++visit) {
    AddPlace(&world_, 0.0);
    AddPlace(&other_world_, -20.0);
  }
  AddPlace(&world_, 20.0);
  EXPECT_FALSE(AreExcluded(20.0));
}

TEST_F(LookAlikesTest, AreExcludedWhereTheMapShowsSomethingElse) {
  AddPlace(&other_world_, 20.0);
  EXPECT_TRUE(AreExcluded(20.0));
}

// The copy may be missing in the map.
TEST_F(LookAlikesTest, RemainPossibleOutsideOfTheMap) { EXPECT_FALSE(AreExcluded(20.0)); }

TEST_F(LookAlikesTest, RemainPossibleAtTheEndOfARow) {
  AddPlace(&world_, -20.0);
  EXPECT_FALSE(AreExcluded(20.0));
}

TEST_F(LookAlikesTest, AreExcludedOutsideOfTheMapIfThePlaceHasNoCopyOnItsOtherSide) {
  AddPlace(&other_world_, -20.0);
  EXPECT_TRUE(AreExcluded(20.0));
}

TEST_F(LookAlikesTest, RemainPossibleBehindSurfacesOfTheFrame) {
  AddPlace(&other_world_, 20.0);
  auto frame = std::make_shared<Frame>(*tracked_.frame);
  frame->depth_ranges.cells.assign(DepthRanges::kColumns * DepthRanges::kRows, {2.0f, 2.0f});
  tracked_.frame = frame;
  EXPECT_FALSE(AreExcluded(20.0));
}

// Each of them is excluded, but not those that are not remembered.
TEST_F(LookAlikesTest, RemainPossibleIfThereAreTooMany) {
  constexpr int kMaxAlignments = 16;
  for (int i = 1; i <= kMaxAlignments; ++i) {
    AddPlace(&other_world_, 20.0 * i);
    EXPECT_EQ(AreExcluded(20.0 * i), i < kMaxAlignments) << i;
  }
}

// The step between two places of the map errs by 0.1 m (one sigma) along x of the keyframes. The
// camera is rotated about its axis, so that this is y of its frame. The two poses differ by 0.2 m
// there: two sigmas, but fourteen in any other direction, in which only the views of the two maps
// err, by 10 mm each. Four are the limit.
TEST_F(LookAlikesTest, AreTheSamePlaceUpToTheDriftInTheFrameOfTheCamera) {
  const Rigid3 roll(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ())),
                    Eigen::Vector3d::Zero());
  constexpr KeyframeId kOther = kFoundPlace + 1;
  AddPlace(&world_, 0.5);
  PoseCovariance step = IsotropicCovariance(1e-4, 1e-3);
  step(3, 3) = 0.1 * 0.1;
  inactive_.map.SetStepCovariance(kOther, step);
  found_.cam_from_reference = roll;
  Revisit other = found_;
  other.reference = kOther;
  other.cam_from_reference = roll * Shift(0.2) * Shift(0.5);
  look_alikes_.Add(tracked_, snapshot_, inactive_.map, other);
  EXPECT_TRUE(look_alikes_.AreExcluded({}, tracked_, snapshot_, inactive_.map, found_));
}

TEST_F(LookAlikesTest, AreForgottenWithTheirMaps) {
  EXPECT_FALSE(AreExcluded(20.0));
  look_alikes_.Update(snapshot_);  // has no inactive map
  EXPECT_TRUE(look_alikes_.AreExcluded({}, tracked_, snapshot_, inactive_.map, found_));
}

}  // namespace
}  // namespace msc_vo
