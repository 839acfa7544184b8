// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_graph.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/map/path_covariance.h"

namespace msc_vo {
namespace {

constexpr int kNumKeyframes = 60;
constexpr double kStep = 0.2;                              // metres
constexpr double kLength = (kNumKeyframes - 1) * kStep;    // metres
constexpr double kTurnStep = 0.1;                          // radians
constexpr double kTurn = (kNumKeyframes - 1) * kTurnStep;  // radians
constexpr int kNumPoints = 25;                             // landmarks that begin per keyframe
constexpr Eigen::Index kAlong = 3;                         // row of the translation along x
constexpr Eigen::Index kAboutY = 1;                        // row of the rotation about y

// A path. The landmarks that begin at a keyframe are observed by `num_observers` in a row.
Map PathWith(const std::function<Rigid3(int)>& cam_from_world, int num_observers) {
  Map map;
  for (int i = 0; i < kNumKeyframes; ++i) {
    auto frame = std::make_shared<Frame>();
    frame->points.resize(static_cast<size_t>(kNumPoints * num_observers));
    map.AddKeyframe(frame, cam_from_world(i));
    map.SetStepCovariance(i, IsotropicCovariance(1e-5, 1e-5));
  }
  for (int i = 0; i < kNumKeyframes; ++i) {
    for (int point = 0; point < kNumPoints; ++point) {
      const LandmarkId id = map.Add<PointLandmark>(i, point, {kStep * i, 0.0, 2.0});
      for (int later = 1; later < num_observers && i + later < kNumKeyframes; ++later) {
        map.Observe<PointLandmark>(id, i + later, kNumPoints * later + point);
      }
    }
  }
  return map;
}

// A straight path along x.
Map StraightPath(int num_observers) {
  const auto cam_from_world = [](int i) {
    return Rigid3(Eigen::Quaterniond::Identity(), {-kStep * i, 0.0, 0.0});
  };
  return PathWith(cam_from_world, num_observers);
}

// A camera that turns on the spot about its y axis.
Map TurnOnTheSpot(int num_observers) {
  const auto cam_from_world = [](int i) {
    return Rigid3(ExpSO3({0.0, kTurnStep * i, 0.0}), Eigen::Vector3d::Zero());
  };
  return PathWith(cam_from_world, num_observers);
}

// Standard deviation of a row of the pose of the last keyframe relative to the first one: the edges
// are independent and the row is not mixed with others along the path, so that it is a network of
// resistors.
double SigmaOf(Eigen::Index row, const PoseGraph& graph) {
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(kNumKeyframes, kNumKeyframes);
  for (const PoseGraphEdge& edge : graph.edges) {
    const double weight = 1.0 / edge.covariance(row, row);
    information(edge.from, edge.from) += weight;
    information(edge.to, edge.to) += weight;
    information(edge.from, edge.to) -= weight;
    information(edge.to, edge.from) -= weight;
  }
  constexpr int kFree = kNumKeyframes - 1;  // the first one is held fixed
  Eigen::VectorXd last = Eigen::VectorXd::Unit(kFree, kFree - 1);
  const Eigen::MatrixXd of_free = information.bottomRightCorner(kFree, kFree);
  return std::sqrt(last.dot(of_free.ldlt().solve(last)));
}

class KeyframeGraphTest : public testing::TestWithParam<int> {
 protected:
  // The largest number of steps between keyframes that share landmarks.
  static int Reach() { return std::max(1, GetParam() - 1); }
};

TEST_P(KeyframeGraphTest, DriftsAsAPathWithSystematicErrorsDoes) {
  const Map map = StraightPath(GetParam());
  const double expected = std::sqrt(SystematicCovariance(kLength, 0.0)(kAlong, kAlong));
  EXPECT_NEAR(SigmaOf(kAlong, MakeKeyframeGraph(map, {}, {kLength, 0.0})), expected,
              0.1 * expected);
  EXPECT_NEAR(SigmaOf(kAlong, MakeKeyframeGraph(map, {}, {0.25 * kLength, 0.0})), 0.5 * expected,
              0.1 * expected);
}

TEST_P(KeyframeGraphTest, DriftsAsATurnWithSystematicErrorsDoes) {
  const Map map = TurnOnTheSpot(GetParam());
  const double expected = std::sqrt(SystematicCovariance(0.0, kTurn)(kAboutY, kAboutY));
  EXPECT_NEAR(SigmaOf(kAboutY, MakeKeyframeGraph(map, {}, {0.0, kTurn})), expected, 0.1 * expected);
  EXPECT_NEAR(SigmaOf(kAboutY, MakeKeyframeGraph(map, {}, {0.0, 0.25 * kTurn})), 0.5 * expected,
              0.15 * expected);
}

// If edges of 1 to r steps bridge a step, each with the same variance v, its variance is
// v / (1 + 4 + ... + r^2), and larger near the ends of the path.
TEST_P(KeyframeGraphTest, HasIndependentErrorsOtherwise) {
  double sum_of_squares = 0.0;
  for (int steps = 1; steps <= Reach(); ++steps) sum_of_squares += steps * steps;
  const double expected =
      std::sqrt((kNumKeyframes - 1) * CommonViewCovariance()(kAlong, kAlong) / sum_of_squares);
  const double along = SigmaOf(kAlong, MakeKeyframeGraph(StraightPath(GetParam()), {}, {}));
  const double about_y = SigmaOf(kAboutY, MakeKeyframeGraph(TurnOnTheSpot(GetParam()), {}, {}));
  EXPECT_NEAR(along, expected, 0.15 * expected);
  EXPECT_NEAR(about_y, expected, 0.15 * expected);
}

TEST_P(KeyframeGraphTest, HasAnEdgePerStepAndPerPairThatSharesLandmarks) {
  const PoseGraph graph = MakeKeyframeGraph(StraightPath(GetParam()), {}, {kLength, 0.0});
  EXPECT_EQ(graph.poses.size(), static_cast<size_t>(kNumKeyframes));
  size_t expected = 0;
  for (int i = 1; i < kNumKeyframes; ++i) expected += static_cast<size_t>(std::min(i, Reach()));
  EXPECT_EQ(graph.edges.size(), expected);
  for (const PoseGraphEdge& edge : graph.edges) {
    EXPECT_LE(edge.to - edge.from, Reach());
    const Rigid3 expected_pose = graph.poses.at(edge.to) * graph.poses.at(edge.from).Inverse();
    EXPECT_TRUE(edge.to_from_from.translation().isApprox(expected_pose.translation(), 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(ByObserversOfALandmark, KeyframeGraphTest, testing::Values(1, 2, 6),
                         testing::PrintToStringParamName());

// A loop whose later keyframe was culled.
class CulledLoopTest : public testing::Test {
 protected:
  CulledLoopTest() {
    loop_ = {10, 50, map_.CamFromWorld(50) * map_.CamFromWorld(10).Inverse(),
             1e-6 * PoseCovariance::Identity()};
    map_.RemoveKeyframe(50, 49);
  }

  void ExpectBetweenKeyframes(const PoseGraphEdge& edge) const {
    EXPECT_EQ(edge.from, 10);
    EXPECT_EQ(edge.to, 49);
    const Rigid3 expected = map_.CamFromWorld(49) * map_.CamFromWorld(10).Inverse();
    EXPECT_TRUE(edge.to_from_from.translation().isApprox(expected.translation(), 1e-12));
    // Along x, the path between both keyframes has no lever arm.
    const double step = DriftBetween(map_, 50, 49).StepsAt(Rigid3())(kAlong, kAlong);
    EXPECT_GT(step, 0.0);
    EXPECT_NEAR(edge.covariance(kAlong, kAlong), 1e-6 + step, 1e-12);
  }

  Map map_ = StraightPath(2);
  PoseGraphEdge loop_;
};

TEST_F(CulledLoopTest, IsAttachedToTheKeyframeBefore) {
  ExpectBetweenKeyframes(MakeKeyframeGraph(map_, {loop_}, {}).edges.back());
}

TEST_F(CulledLoopTest, IsKeptBetweenKeyframesOfTheSavedMap) {
  std::vector<SavedSubMap> submaps(2);  // the first one is empty
  submaps[1].map = map_.Share();
  const PoseGraphEdge within = {48, 50, Rigid3(), PoseCovariance::Identity()};
  const PoseGraphEdge of_one = {49, 50, Rigid3(), PoseCovariance::Identity()};
  const std::vector<PoseGraphEdge> loops =
      LoopsBetweenKeyframes(submaps, {of_one, loop_, within, {10, 99, Rigid3(), {}}});
  ASSERT_EQ(loops.size(), 2u);
  ExpectBetweenKeyframes(loops[0]);
  EXPECT_EQ(loops[1].from, 48);
}

}  // namespace
}  // namespace msc_vo
