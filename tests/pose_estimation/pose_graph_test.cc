// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_graph.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

constexpr int kNumKeyframes = 24;
constexpr double kSigma = 0.01;  // metres and radians, of each edge

Rigid3 PoseOnCircle(int i) {
  const double angle = 2.0 * M_PI * i / kNumKeyframes;
  return Rigid3(ExpSO3({0.0, angle, 0.0}),
                {std::sin(angle), 0.1 * std::sin(3.0 * angle), std::cos(angle)})
      .Inverse();
}

PoseGraphEdge TrueEdge(int from, int to) {
  return {from, to, PoseOnCircle(to) * PoseOnCircle(from).Inverse(),
          kSigma * kSigma * PoseCovariance::Identity()};
}

double Error(const PoseGraph& graph, int i) {
  const Rigid3 error = graph.poses.at(i) * PoseOnCircle(i).Inverse();
  return error.translation().norm() + LogSO3(error.rotation()).norm();
}

// A closed path around a circle, and how odometry has it: each step turns a little too far.
PoseGraph Drifted(double turn) {
  PoseGraph graph;
  graph.poses[0] = PoseOnCircle(0);
  for (int i = 1; i < kNumKeyframes; ++i) {
    PoseGraphEdge edge = TrueEdge(i - 1, i);
    edge.to_from_from =
        Rigid3(ExpSO3({0.0, turn, 0.0}), Eigen::Vector3d::Zero()) * edge.to_from_from;
    graph.edges.push_back(edge);
    graph.poses[i] = edge.to_from_from * graph.poses[i - 1];
  }
  return graph;
}

TEST(PoseGraph, RemainsAsItIsIfNothingContradictsIt) {
  PoseGraph graph = Drifted(0.002);
  const PoseGraph before = graph;
  EXPECT_THAT(OptimizePoseGraph(&graph), testing::Each(testing::Lt(1e-12)));
  for (const auto& [id, pose] : before.poses) {
    EXPECT_TRUE(graph.poses.at(id).params.isApprox(pose.params, 1e-9)) << id;
  }
}

TEST(PoseGraph, SpreadsTheErrorOfALoop) {
  PoseGraph graph = Drifted(0.002);
  const double last_before = Error(graph, kNumKeyframes - 1);
  PoseGraphEdge loop = TrueEdge(0, kNumKeyframes - 1);
  loop.covariance *= 1e-4;
  graph.edges.push_back(loop);
  const std::vector<double> squared_errors = OptimizePoseGraph(&graph);
  ASSERT_EQ(squared_errors.size(), graph.edges.size());
  EXPECT_LT(*std::max_element(squared_errors.begin(), squared_errors.end()), 1.0);
  EXPECT_EQ(graph.poses.at(0).params, PoseOnCircle(0).params);  // held fixed
  EXPECT_LT(Error(graph, kNumKeyframes - 1), 0.02 * last_before);
  for (int i = 1; i < kNumKeyframes; ++i) EXPECT_LT(Error(graph, i), 0.7 * last_before) << i;
}

TEST(PoseGraph, ReportsAContradiction) {
  PoseGraph graph = Drifted(0.0);
  graph.edges.push_back(TrueEdge(0, kNumKeyframes - 1));
  PoseGraphEdge wrong = TrueEdge(2, 17);
  wrong.to_from_from.translation() += Eigen::Vector3d(1.0, 0.0, 0.0);
  graph.edges.push_back(wrong);
  const std::vector<double> squared_errors = OptimizePoseGraph(&graph);
  EXPECT_GT(*std::max_element(squared_errors.begin(), squared_errors.end()), 50.0);
}

}  // namespace
}  // namespace msc_vo
