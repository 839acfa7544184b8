// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/loop_closer.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/path_covariance.h"

namespace msc_vo {
namespace {

constexpr int kNumOnWalk = 40;   // keyframes
constexpr int kNumInRound = 36;  // keyframe 36 is where keyframe 0 was

// A camera that walks on a circle of 2 m; the odometry turns a little too far with every step.
class LoopCloserTest : public testing::Test {
 protected:
  LoopCloserTest() {
    PoseCovariance step = PoseCovariance::Zero();
    step.diagonal().head<3>().setConstant(std::pow(0.001, 2));
    step.diagonal().tail<3>().setConstant(std::pow(0.001, 2));
    const Rigid3 drift(ExpSO3({0.0, 0.0005, 0.0}), {0.0, 0.0, 0.0005});
    Rigid3 pose = Truth(0);
    for (int i = 0; i < kNumOnWalk; ++i) {
      if (i > 0) pose = drift * Truth(i) * Truth(i - 1).Inverse() * pose;
      auto frame = std::make_shared<Frame>();
      frame->points.resize(1);
      map_.AddKeyframe(frame, pose);
      map_.SetStepCovariance(i, step);
    }
  }

  static Rigid3 Truth(int i) {
    const double angle = 2.0 * M_PI * i / kNumInRound;
    return Rigid3(ExpSO3({0.0, angle, 0.0}), {2.0 * std::sin(angle), 0.0, 2.0 * std::cos(angle)})
        .Inverse();
  }
  double Error(KeyframeId id) const {
    return (map_.CamFromWorld(id).OriginInSource() - Truth(static_cast<int>(id)).OriginInSource())
        .norm();
  }
  // Keyframe `i` shows the place of keyframe `reference`, `offset` metres from the truth.
  void Revisit(int i, int reference, double offset) {
    msc_vo::Revisit revisit;
    revisit.reference = reference;
    const Rigid3 shift(Eigen::Quaterniond::Identity(), {offset, 0.0, 0.0});  // of the world
    revisit.cam_from_reference = Truth(i) * shift * Truth(reference).Inverse();
    revisit.covariance = kCovariance;
    closer_.AddRevisit({i, kCovariance, revisit});
  }

  static inline const PoseCovariance kCovariance = 1e-6 * PoseCovariance::Identity();
  Map map_;
  LoopCloser closer_;
};

TEST_F(LoopCloserTest, CorrectsThePathIfThreeKeyframesAgree) {
  const LandmarkId old = map_.Add<PointLandmark>(1, 0, {0.0, 0.0, 1.0});
  const LandmarkId copy = map_.Add<PointLandmark>(37, 0, {0.0, 0.0, 1.0});
  for (const int i : {36, 37}) {
    Revisit(i, i - kNumInRound, 0.0);
    EXPECT_FALSE(closer_.TryClose(&map_));
  }
  const double before = Error(38), middle_before = Error(20);
  msc_vo::Revisit last{2, Truth(38) * Truth(2).Inverse(), kCovariance, {}};
  last.matches.points.push_back({0, old});
  closer_.AddRevisit({38, kCovariance, last});
  const std::optional<LoopClosure> loop = closer_.TryClose(&map_);
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->keyframe, 38);
  EXPECT_EQ(loop->reference, 2);
  EXPECT_EQ(loop->num_keyframes, 3);
  EXPECT_EQ(map_.CamFromWorld(0).params, Truth(0).params);
  EXPECT_LT(Error(38), 0.2 * before);
  EXPECT_LT(Error(20), middle_before);
  EXPECT_NEAR(loop->new_from_old_camera.translation().norm(), before, 0.2 * before);
  EXPECT_NE(FindObservation(*map_.Find<PointLandmark>(old), 38), nullptr);
  EXPECT_NE(map_.Find<PointLandmark>(copy), nullptr);  // no match says that it is the same
  EXPECT_EQ(closer_.num_closed(), 1);
  EXPECT_EQ(closer_.num_refused(), 0);
  EXPECT_FALSE(closer_.TryClose(&map_));  // it is closed
}

// The keyframe with the next lower id may be anywhere: it must not be bound to keyframe 10.
TEST_F(LoopCloserTest, IgnoresLoopsOfKeyframesThatTheMapDoesNotKnow) {
  map_.AddKeyframe(map_.FindKeyframe(39)->frame, map_.CamFromWorld(39), 45);
  Map with_edge = map_.Share();
  LoopCloser closer;
  closer.AddEdges({{10, 43, Rigid3(), 1e-6 * kCovariance}});
  for (const int i : {36, 37, 38}) {
    Revisit(i, i - kNumInRound, 0.0);
    closer.AddRevisit(
        {i, kCovariance, {i - kNumInRound, Truth(i) * Truth(i - 36).Inverse(), kCovariance, {}}});
  }
  ASSERT_TRUE(closer_.TryClose(&map_));
  ASSERT_TRUE(closer.TryClose(&with_edge));
  for (const auto& [id, keyframe] : map_.keyframes()) {
    EXPECT_EQ(with_edge.CamFromWorld(id).params, keyframe.cam_from_world.params) << id;
  }
}

// After the loop, keyframes are tracked in the part of the map that the first round has made.
TEST_F(LoopCloserTest, LinksKeyframesToThePartsOfTheMapThatTheyAreTrackedIn) {
  const auto add = [this](KeyframeId id, KeyframeId reference) {
    if (map_.FindKeyframe(id) == nullptr) {
      const int place = static_cast<int>(id) - kNumInRound;
      map_.AddKeyframe(map_.FindKeyframe(0)->frame, map_.CamFromWorld(place), id);
      map_.SetStepCovariance(id, kCovariance);
    }
    closer_.AddKeyframe(map_, id, reference);
  };
  add(39, 3);  // there is no loop
  EXPECT_TRUE(closer_.edges().empty());
  for (const int i : {36, 37, 38}) Revisit(i, i - kNumInRound, 0.0);
  ASSERT_TRUE(closer_.TryClose(&map_));
  ASSERT_EQ(closer_.edges().size(), 3u);
  const double before = PathCovariances(map_, closer_.edges(), 0).Of(38).trace();
  for (KeyframeId id = 39; id < 60; ++id) add(id, id - kNumInRound);
  ASSERT_EQ(closer_.edges().size(), 3u + 4u);  // 43, 48, 53, 58
  EXPECT_EQ(closer_.edges()[3].from, 7);
  EXPECT_EQ(closer_.edges()[3].to, 43);
  // As far from the origin as the keyframe of the first round beside it, not once around.
  const PathCovariances linked(map_, closer_.edges(), 0);
  EXPECT_LT(linked.Of(58).trace(), 1.5 * linked.Of(22).trace());
  EXPECT_GT(linked.Of(58).trace(), before);
  add(60, 59);  // another part: nothing older than the last edge
  add(65, 58);
  EXPECT_EQ(closer_.edges().size(), 7u);
}

// The error of a calibration is the same in every step. Keyframes that share landmarks must not
// hold the path for more certain than that.
TEST_F(LoopCloserTest, CorrectsSystematicDriftOfKeyframesThatShareLandmarks) {
  constexpr int kShared = 20, kNumObservers = 6;
  const Rigid3 drift(ExpSO3({0.0, 0.0006, 0.0}), {0.001, 0.0, 0.0});
  auto frame = std::make_shared<Frame>();
  frame->points.resize(kShared * kNumObservers);
  Map map;
  Rigid3 pose = Truth(0);
  for (int i = 0; i < kNumOnWalk; ++i) {
    if (i > 0) pose = drift * Truth(i) * Truth(i - 1).Inverse() * pose;
    map.AddKeyframe(frame, pose);
    map.SetStepCovariance(i, IsotropicCovariance(1e-4, 1e-4));
  }
  for (int i = 0; i < kNumOnWalk; ++i) {
    for (int k = 0; k < kShared; ++k) {
      const LandmarkId id = map.Add<PointLandmark>(i, k, {0.0, 0.0, 0.0});
      for (int j = 1; j < kNumObservers && i + j < kNumOnWalk; ++j) {
        map.Observe<PointLandmark>(id, i + j, kShared * j + k);
      }
    }
  }
  map_ = map.Share();
  ASSERT_GE(map_.FindCovisible(20).size(), 10u);
  const double before = Error(38);
  EXPECT_GT(before, 0.03);
  // The first loop may be the one that errs.
  for (const int i : {36, 37, 38}) Revisit(i, i - kNumInRound, 0.0);
  EXPECT_FALSE(closer_.TryClose(&map_));
  for (const int i : {37, 38, 39}) Revisit(i, i - kNumInRound, 0.0);
  ASSERT_TRUE(closer_.TryClose(&map_));
  EXPECT_LT(Error(38), 0.2 * before);
  EXPECT_LT(Error(18), before);
}

// A wrong focal length errs by a ratio of each angle: nearly two degrees in a whole turn, on a path
// without length.
TEST_F(LoopCloserTest, CorrectsTheTurnOfACameraThatStaysInPlace) {
  const auto turned = [](double i) {
    const double angle = 2.0 * M_PI * i / kNumInRound;
    return Rigid3(ExpSO3({0.0, angle, 0.0}), Eigen::Vector3d(0.01 * std::sin(angle), 0.0, 0.0));
  };
  Map map;
  for (int i = 0; i < kNumOnWalk; ++i) {
    map.AddKeyframe(map_.FindKeyframe(0)->frame, turned(1.005 * i));
    map.SetStepCovariance(i, IsotropicCovariance(1e-4, 1e-4));
  }
  const auto revisit = [&](int i) {
    const int reference = i - kNumInRound;
    closer_.AddRevisit(
        {i, kCovariance, {reference, turned(i) * turned(reference).Inverse(), kCovariance, {}}});
    return closer_.TryClose(&map).has_value();
  };
  const auto error = [&](int i) {
    return LogSO3((map.CamFromWorld(i) * turned(i).Inverse()).rotation()).norm();
  };
  EXPECT_GT(error(38), 0.03);
  EXPECT_FALSE(revisit(36));
  EXPECT_FALSE(revisit(37));
  ASSERT_TRUE(revisit(38));
  EXPECT_EQ(closer_.num_refused(), 0);
  EXPECT_LT(error(38), 0.005);
  EXPECT_LT(error(18), 0.005);  // the error is spread over the turn
}

TEST_F(LoopCloserTest, RefusesWhatDriftCannotExplain) {
  const Map before = map_.Share();
  for (const int i : {36, 37, 38}) {
    Revisit(i, i - kNumInRound, 1.5);  // the next room looks alike
    EXPECT_FALSE(closer_.TryClose(&map_));
  }
  EXPECT_EQ(closer_.num_refused(), 1);
  EXPECT_EQ(closer_.num_closed(), 0);
  for (int i = 0; i < kNumOnWalk; ++i) {
    EXPECT_EQ(map_.CamFromWorld(i).params, before.CamFromWorld(i).params) << i;
  }
}

TEST_F(LoopCloserTest, WaitsForKeyframesThatAgree) {
  const double offsets[] = {0.2, -0.3, 0.6, -0.9};
  for (int i = 0; i < 4; ++i) {
    Revisit(kNumInRound + i, i, offsets[i]);
    EXPECT_FALSE(closer_.TryClose(&map_));
  }
  EXPECT_EQ(closer_.num_refused(), 0);
}

TEST_F(LoopCloserTest, ForgetsKeyframesThatWereCulled) {
  for (const int i : {36, 37, 38}) Revisit(i, i - kNumInRound, 0.0);
  map_.RemoveKeyframe(1, 2);
  EXPECT_FALSE(closer_.TryClose(&map_));
}

}  // namespace
}  // namespace msc_vo
