// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/path_covariance.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

PoseCovariance PathCovariance(const Map& map, KeyframeId a, KeyframeId b) {
  return DriftBetween(map, a, b).At(Rigid3());
}

constexpr double kRotationVariance = 1e-6, kVariance = 1e-4;  // of a step, radians^2 and m^2

// Keyframes at 1 m from each other on a straight line along x, which all look along z.
class PathCovarianceTest : public testing::Test {
 protected:
  PathCovarianceTest() {
    PoseCovariance step = PoseCovariance::Zero();
    step.diagonal().head<3>().setConstant(kRotationVariance);
    step.diagonal().tail<3>().setConstant(kVariance);
    for (int i = 0; i < 12; ++i) {
      map_.AddKeyframe(std::make_shared<Frame>(), CameraAt(i));
      map_.SetStepCovariance(i, step);
    }
  }
  static Rigid3 CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}}; }
  double Along(int a, int b) const { return PathCovariance(map_, a, b)(3, 3); }
  double Across(int a, int b) const { return PathCovariance(map_, a, b)(4, 4); }

  Map map_;
};

TEST_F(PathCovarianceTest, GrowsWithEveryStep) {
  EXPECT_EQ(PathCovariance(map_, 5, 5), PoseCovariance::Zero());
  const double step = Along(5, 6);
  EXPECT_GE(step, kVariance);  // the landmarks err, too
  for (int i = 2; i < 7; ++i) {
    EXPECT_GE(Along(5, 5 + i), i * step) << i;  // at least if all errors are independent
    EXPECT_LE(Along(5, 5 + i), i * i * step) << i;
  }
}

// Early errors of the orientation have the longest lever.
TEST_F(PathCovarianceTest, GrowsFasterAcrossThePath) {
  for (int i = 2; i < 10; ++i) {
    const double by_lever = kRotationVariance * i * i * i / 3.0 * 0.5;
    EXPECT_GE(Across(0, i), Along(0, i) + by_lever) << i;
  }
}

TEST_F(PathCovarianceTest, IsThatOfTheSameStepsInBothDirections) {
  const Rigid3 b_from_a = map_.CamFromWorld(9) * map_.CamFromWorld(2).Inverse();
  const PoseCovariance forwards = PathCovariance(map_, 2, 9);
  const PoseCovariance backwards = TransportCovariance(b_from_a, PathCovariance(map_, 9, 2));
  EXPECT_TRUE((backwards.topLeftCorner<3, 3>().isApprox(forwards.topLeftCorner<3, 3>(), 1e-9)));
  EXPECT_NEAR(backwards(3, 3), forwards(3, 3), 1e-9);
}

TEST_F(PathCovarianceTest, CountsKeyframesThatWereCulled) {
  const PoseCovariance before = PathCovariance(map_, 1, 8);
  map_.RemoveKeyframe(4, 5);
  map_.RemoveKeyframe(5, 6);
  EXPECT_TRUE(PathCovariance(map_, 1, 8).isApprox(before, 1e-9));
}

TEST_F(PathCovarianceTest, BoundsTheDrift) {
  const Rigid3 by_path = map_.CamFromWorld(10) * map_.CamFromWorld(0).Inverse();
  const PoseCovariance none = PoseCovariance::Zero();
  const auto is_possible = [&](const Rigid3& error, const PoseCovariance& covariance) {
    return IsPossibleDrift(by_path, error * by_path, PathCovariance(map_, 0, 10) + covariance);
  };
  const auto shift = [](double metres) {
    return Rigid3(Eigen::Quaterniond::Identity(), {metres, 0.0, 0.0});
  };
  const double sigma = std::sqrt(Along(0, 10));
  EXPECT_TRUE(is_possible(shift(0.0), none));
  EXPECT_TRUE(is_possible(shift(2.0 * sigma), none));
  EXPECT_FALSE(is_possible(shift(6.0 * sigma), none));
  EXPECT_FALSE(is_possible({ExpSO3({0.0, 0.5, 0.0}), Eigen::Vector3d::Zero()}, none));
  // An inexact measurement allows more.
  EXPECT_TRUE(is_possible(shift(6.0 * sigma), 9.0 * Along(0, 10) * PoseCovariance::Identity()));
}

// A camera that turns on the spot about its y axis, by 15 degrees per keyframe.
constexpr double kTurnStep = M_PI / 12.0;
constexpr double kTurnRatio = 0.005;  // standard deviation of an angle relative to the angle

Rigid3 Turned(double steps) { return {ExpSO3({0.0, -kTurnStep * steps, 0.0}), {0.0, 0.0, 0.0}}; }

class TurnTest : public testing::Test {
 protected:
  void AddKeyframe(const Rigid3& cam_from_world) {
    map_.SetStepCovariance(map_.AddKeyframe(std::make_shared<Frame>(), cam_from_world),
                           PoseCovariance::Zero());
  }
  // Standard deviations of the last keyframe relative to the first one, in its frame.
  Eigen::Matrix<double, 6, 1> Sigma() const {
    return PathCovariance(map_, 0, map_.KnownKeyframes().back()).diagonal().cwiseSqrt();
  }

  Map map_;
};

TEST_F(TurnTest, ErrsByARatioOfTheAngle) {
  for (int i = 0; i <= 48; ++i) {
    AddKeyframe(Turned(i));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(Sigma()[axis], kTurnRatio * kTurnStep * i, 1e-9) << i;  // whole turns count
    }
  }
}

TEST_F(TurnTest, ErrsByNothingOnceItIsUndone) {
  for (int i = 0; i <= 12; ++i) AddKeyframe(Turned(i));
  EXPECT_NEAR(Sigma()[1], kTurnRatio * M_PI, 1e-9);
  for (int i = 11; i >= 0; --i) AddKeyframe(Turned(i));
  EXPECT_LT(Sigma().norm(), 1e-9);
}

// The camera errs sideways by the distance that it goes after the turn.
TEST_F(TurnTest, HasALever) {
  for (int i = 0; i <= 24; ++i) AddKeyframe(Turned(i));
  for (int i = 1; i <= 10; ++i) {
    AddKeyframe({Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.0 * i}});
  }
  const double by_length = 0.005 * 10.0, by_turn = kTurnRatio * 2.0 * M_PI * 10.0;
  EXPECT_NEAR(Sigma()[3], std::hypot(by_length, by_turn), 1e-6);
  EXPECT_NEAR(Sigma()[5], by_length, 1e-6);  // along the path
}

// A motion across the view and a turn look alike: the position errs while the camera looks
// elsewhere, by a ratio of the distance of the surfaces.
TEST_F(TurnTest, MovesTheCameraWhileItLooksElsewhere) {
  double largest = 0.0;
  for (int i = 0; i <= 24; ++i) {
    AddKeyframe(Turned(i));
    largest = std::max(largest, Sigma()[3]);
    EXPECT_NEAR(Sigma()[3], kTurnRatio * 2.5 * 2.0 * std::sin(kTurnStep * i / 2.0), 1e-9) << i;
  }
  EXPECT_NEAR(largest, 0.025, 1e-6);
}

// Keyframes on a circle, looking outwards, about 1 m from each other: the last one is beside the
// first one.
class LoopCovarianceTest : public testing::Test {
 protected:
  static constexpr int kNumKeyframes = 24;

  LoopCovarianceTest() {
    for (int i = 0; i < kNumKeyframes; ++i) {
      const double angle = 2.0 * M_PI * i / kNumKeyframes;
      const Rigid3 world_from_cam(ExpSO3({0.0, angle, 0.0}),
                                  {4.0 * std::sin(angle), 0.0, 4.0 * std::cos(angle)});
      map_.AddKeyframe(std::make_shared<Frame>(), world_from_cam.Inverse());
      map_.SetStepCovariance(i, IsotropicCovariance(0.01, 0.05));
    }
  }
  PoseGraphEdge EdgeBetween(KeyframeId from, KeyframeId to) const {
    const Rigid3 to_from_from = map_.CamFromWorld(to) * map_.CamFromWorld(from).Inverse();
    return {from, to, to_from_from,
            CovarianceOfCamera(to_from_from, IsotropicCovariance(0.002, 0.01))};
  }
  static bool IsSmaller(const PoseCovariance& a, const PoseCovariance& b) {
    const PoseCovariance difference = b - a;
    return difference.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0.0;
  }
  // Covariance of keyframe `id` relative to the first one in its own frame, given all steps and
  // loops, without the systematic part: the edges are linear in errors expressed in one frame.
  PoseCovariance Marginal(const std::vector<PoseGraphEdge>& loops, int id) const {
    const Rigid3 root_from_world = map_.CamFromWorld(0);
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(6 * kNumKeyframes, 6 * kNumKeyframes);
    const auto add = [&](KeyframeId from, KeyframeId to, const PoseCovariance& camera) {
      const PoseCovariance weight =
          TransportCovariance(root_from_world * map_.CamFromWorld(to).Inverse(), 4.0 * camera)
              .inverse();
      information.block<6, 6>(6 * from, 6 * from) += weight;
      information.block<6, 6>(6 * to, 6 * to) += weight;
      information.block<6, 6>(6 * from, 6 * to) -= weight;
      information.block<6, 6>(6 * to, 6 * from) -= weight;
    };
    for (int i = 1; i < kNumKeyframes; ++i) add(i - 1, i, *map_.StepCovariance(i));
    for (const PoseGraphEdge& loop : loops) {
      add(loop.from, loop.to, CameraCovariance(loop.to_from_from, loop.covariance));
    }
    const int size = 6 * (kNumKeyframes - 1);  // the first one is fixed
    const Eigen::MatrixXd covariance = information.bottomRightCorner(size, size).inverse();
    return TransportCovariance(map_.CamFromWorld(id) * root_from_world.Inverse(),
                               covariance.block<6, 6>(6 * (id - 1), 6 * (id - 1)));
  }

  Map map_;
};

TEST_F(LoopCovarianceTest, IsThatOfThePathWithoutLoops) {
  map_.RemoveKeyframe(7, 8);
  for (const KeyframeId root : {0, 5, 7, 23}) {
    const PathCovariances covariances(map_, {}, root);
    for (KeyframeId id = 0; id < kNumKeyframes; ++id) {
      EXPECT_TRUE(covariances.Of(id).isApprox(PathCovariance(map_, root, id), 1e-9)) << id;
      EXPECT_TRUE(covariances.OfRoot(id).isApprox(PathCovariance(map_, id, root), 1e-9)) << id;
    }
  }
}

TEST_F(LoopCovarianceTest, GoesOnToACameraNearAKeyframe) {
  const PathCovariances covariances(map_, {}, 0);
  const Rigid3 cam_from_keyframe(ExpSO3({0.0, -0.5, 0.0}), {0.6, 0.0, 0.8});  // 1 m
  const PoseCovariance camera = covariances.Of(2, cam_from_keyframe);
  // The rotation, 10 mrad twice with four times the variance, has a lever of 1 m across it.
  const double length = 2.0 * 8.0 * std::sin(M_PI / kNumKeyframes) + 1.0;
  const double turn = 2.0 * kTurnStep + 0.5;
  const double systematic =
      std::pow(0.05 * M_PI / 180.0 * length, 2) + std::pow(kTurnRatio * turn, 2);
  EXPECT_NEAR(camera(1, 1), 8.0 * std::pow(0.01, 2) + systematic, 1e-9);
  EXPECT_TRUE(IsSmaller(TransportCovariance(cam_from_keyframe, covariances.Of(2)),
                        camera + 1e-12 * PoseCovariance::Identity()));
}

TEST_F(LoopCovarianceTest, TakesTheShorterWayThroughLoops) {
  const std::vector<PoseGraphEdge> loops{EdgeBetween(0, 23)};
  const PathCovariances open(map_, {}, 0), closed(map_, loops, 0);
  for (KeyframeId id = 1; id <= 11; ++id) EXPECT_EQ(closed.Of(id), open.Of(id)) << id;
  for (KeyframeId id = 13; id < kNumKeyframes; ++id) {
    EXPECT_LT(closed.OfRoot(id).trace(), open.OfRoot(id).trace()) << id;
  }
  for (KeyframeId id = 20; id < kNumKeyframes; ++id) {
    EXPECT_TRUE(IsSmaller(closed.Of(id), open.Of(id))) << id;  // in all directions
  }
  // The edges beside the loop: of the same length, and the loop is more accurate.
  EXPECT_TRUE(IsSmaller(closed.OfRoot(23), open.OfRoot(1)));
  EXPECT_NEAR(closed.OfRoot(22).trace(), (closed.OfRoot(23) + open.OfRoot(1)).trace(),
              0.3 * closed.OfRoot(22).trace());
  // The same in both directions.
  const PathCovariances from_last(map_, {EdgeBetween(23, 0)}, 23);
  EXPECT_LT(from_last.Of(0).trace(), open.OfRoot(1).trace());
}

TEST_F(LoopCovarianceTest, IsNotSmallerThanTheMarginalOfTheGraph) {
  const std::vector<PoseGraphEdge> loops{EdgeBetween(0, 23), EdgeBetween(3, 15)};
  const PathCovariances covariances(map_, loops, 0);
  for (int id = 1; id < kNumKeyframes; ++id) {
    EXPECT_TRUE(IsSmaller(Marginal(loops, id), covariances.Of(id))) << id;
  }
  // Without loops, the marginal is the path without its systematic part.
  const PoseCovariance systematic = PathCovariances(map_, {}, 0).Of(2) - Marginal({}, 2);
  const double length = 2.0 * 8.0 * std::sin(M_PI / kNumKeyframes);
  EXPECT_NEAR(std::sqrt(systematic(1, 1)),
              std::hypot(0.05 * M_PI / 180.0 * length, kTurnRatio * 2.0 * kTurnStep), 1e-6);
  // Sideways: the length, the change of the direction of view, and the levers of both turns.
  const double view = 2.5 * 2.0 * std::sin(kTurnStep);
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  for (int i = 1; i <= 2; ++i) {
    const Eigen::Vector3d begin = map_.CamFromWorld(i - 1).OriginInSource();
    const Eigen::Vector3d end = map_.CamFromWorld(i).OriginInSource();
    lever += kTurnStep * (map_.CamFromWorld(2) * Eigen::Vector3d(0.5 * (begin + end)));
  }
  EXPECT_NEAR(std::sqrt(systematic(3, 3)),
              std::sqrt(std::pow(0.005 * length, 2) + std::pow(kTurnRatio * view, 2) +
                        std::pow(kTurnRatio * lever.z(), 2)),
              1e-6);
}

TEST_F(LoopCovarianceTest, IgnoresLoopsOfOtherMaps) {
  const auto to_other = [](KeyframeId from, KeyframeId to) {
    return PoseGraphEdge{from, to, Rigid3(), PoseCovariance::Identity()};
  };
  const PathCovariances open(map_, {}, 0), other(map_, {EdgeBetween(0, 23), to_other(0, 99)}, 0);
  EXPECT_LT(other.Of(23).trace(), open.Of(23).trace());
  EXPECT_EQ(PathCovariances(map_, {to_other(0, 99), to_other(77, 23)}, 0).Of(23), open.Of(23));
}

}  // namespace
}  // namespace msc_vo
