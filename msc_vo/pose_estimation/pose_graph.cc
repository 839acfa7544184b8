// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/pose_graph.h"

#include <memory>

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "msc_vo/factors/relative_pose.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

std::vector<double> OptimizePoseGraph(PoseGraph* graph) {
  std::map<KeyframeId, Rigid3> poses = graph->poses;
  Rigid3Manifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  for (auto& [id, pose] : poses) {
    problem.AddParameterBlock(pose.params.data(), 7, &manifold);
  }
  if (!poses.empty()) problem.SetParameterBlockConstant(poses.begin()->second.params.data());
  for (const PoseGraphEdge& edge : graph->edges) {
    problem.AddResidualBlock(RelativePose::Create(edge.to_from_from, edge.covariance), nullptr,
                             poses.at(edge.from).params.data(), poses.at(edge.to).params.data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  std::vector<double> squared_errors;
  for (const PoseGraphEdge& edge : graph->edges) {
    double residuals[6];
    RelativePose(edge.to_from_from, edge.covariance)(poses.at(edge.from).params.data(),
                                                     poses.at(edge.to).params.data(), residuals);
    squared_errors.push_back(Eigen::Map<Eigen::Matrix<double, 6, 1>>(residuals).squaredNorm());
  }
  graph->poses = std::move(poses);
  return squared_errors;
}

}  // namespace msc_vo
