// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_step.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/bundle_adjustment/internal/schur_complement.h"
#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

// x = -H^-1 (gradient + sum W_i^T y_i), with y the solution of the reduced system.
template <int N>
Eigen::Matrix<double, N, 1> Substitute(const EliminatedBlock<N>& block,
                                       const Eigen::VectorXd& reduced) {
  Eigen::Matrix<double, N, 1> right = block.gradient;
  for (int a = 0; a < block.num_poses; ++a) {
    right.noalias() += block.pose_couplings[a].transpose() * reduced.segment<6>(6 * block.poses[a]);
  }
  for (const DirectionCoupling<N>& a : block.direction_couplings) {
    right.noalias() += a.block.transpose() * reduced.segment<2>(a.row);
  }
  return -(block.inverse * right);
}

void SubstituteBack(const BlockStructure& structure, const SchurComplement& schur,
                    WindowStep* step) {
  step->points.resize(structure.num_points);
  for (int i = 0; i < structure.num_points; ++i) {
    const int row = structure.point_row[i];
    step->points[i] = row < 0 ? Substitute(schur.points()[i], step->reduced)
                              : Eigen::Vector3d(step->reduced.segment<3>(row));
  }
  step->lines.resize(structure.num_lines);
  for (int i = 0; i < structure.num_lines; ++i) {
    const int number = structure.reduced_line[i];
    if (number < 0) {
      step->lines[i] = Substitute(schur.lines()[i], step->reduced);
      continue;
    }
    const ReducedLine& line = schur.reduced_lines()[number];
    const Eigen::Vector4d position =
        line.position_row < 0 ? Substitute(line.position, step->reduced)
                              : Eigen::Vector4d(step->reduced.segment<4>(line.position_row));
    step->lines[i] = line.basis.leftCols<4>() * position +
                     line.basis.rightCols<2>() * step->reduced.segment<2>(line.row);
  }
  step->extra.clear();
  for (size_t i = 0; i < structure.extra_size.size(); ++i) {
    step->extra.push_back(step->reduced.segment(structure.extra_row[i], structure.extra_size[i]));
  }
}

// -g^T x - x^T H x / 2, where H x = -g - D x / radius.
double ModelDecrease(const BlockStructure& structure, const WindowEquations& equations,
                     double radius, const WindowStep& step) {
  double sum = 0.0;
  const auto add = [&](const auto& hessian, const auto& gradient, const auto& x) {
    sum += x.dot(Damping(hessian, radius).cwiseProduct(x) - gradient);
  };
  for (int i = 0; i < structure.num_poses; ++i) {
    add(equations.pose_hessian[i], equations.pose_gradient[i],
        Vector6d(step.reduced.segment<6>(6 * i)));
  }
  for (int i = 0; i < structure.num_points; ++i) {
    add(equations.points.hessian[i], equations.points.gradient[i], step.points[i]);
  }
  for (int i = 0; i < structure.num_lines; ++i) {
    add(equations.lines.hessian[i], equations.lines.gradient[i], step.lines[i]);
  }
  for (size_t i = 0; i < structure.extra_size.size(); ++i) {
    add(equations.extra_hessian[i], equations.extra_gradient[i], step.extra[i]);
  }
  return 0.5 * sum;
}

// Without a manifold, *sum = value on entry.
void AddInTangentSpace(const Eigen::VectorXd& step, const ceres::Manifold* manifold,
                       const double* value, double* sum) {
  if (manifold != nullptr) {
    manifold->Plus(value, step.data(), sum);
  } else {
    Eigen::Map<Eigen::VectorXd>(sum, step.size()) += step;
  }
}

// Resets landmarks that a step moved behind a camera that observes them.
template <int Points, typename Observation, typename Block>
void KeepInFront(const std::vector<Observation>& observations, const std::vector<int>& unknown,
                 const WindowState& before, const Block& block, WindowState* after) {
  for (const Observation& o : observations) {
    if (unknown[o.landmark] < 0) continue;
    double* const landmark = block(after, o.landmark);
    const Rigid3 cam_from_world = after->Pose(o.keyframe);
    for (int k = 0; k < Points; ++k) {
      const Eigen::Vector3d x_in_cam = cam_from_world * o.PointInWorld(k, landmark);
      if (x_in_cam.z() >= kMinCameraDepth) continue;
      std::copy_n(block(&before, o.landmark), 3 * Points, landmark);
      break;
    }
  }
}

// Resets lines that a step left without a direction.
void KeepDirections(const BlockStructure& structure, const WindowState& before,
                    WindowState* after) {
  for (size_t i = 0; i < structure.line.size(); ++i) {
    if (structure.line[i] < 0 || after->Line(i).Length() >= kMinLineLength) continue;
    std::copy_n(before.LineBlock(i), 6, after->LineBlock(i));
  }
}

}  // namespace

bool SolveStep(const BlockStructure& structure, const WindowEquations& equations, double radius,
               WindowStep* step) {
  SchurComplement schur(structure, equations, radius);
  if (!schur.Solve(&step->reduced)) return false;
  SubstituteBack(structure, schur, step);
  step->model_decrease = ModelDecrease(structure, equations, radius, *step);
  return std::isfinite(step->model_decrease);
}

WindowState Plus(const BlockStructure& structure, const WindowState& state,
                 const WindowStep& step) {
  WindowState sum = state;
  for (size_t i = 0; i < structure.pose.size(); ++i) {
    if (structure.pose[i] < 0) continue;
    Rigid3Manifold().Plus(state.PoseBlock(i), &step.reduced[6 * structure.pose[i]],
                          sum.PoseBlock(i));
  }
  for (size_t i = 0; i < structure.point.size(); ++i) {
    if (structure.point[i] < 0) continue;
    Eigen::Map<Eigen::Vector3d>(sum.PointBlock(i)) += step.points[structure.point[i]];
  }
  for (size_t i = 0; i < structure.line.size(); ++i) {
    if (structure.line[i] < 0) continue;
    Eigen::Map<Vector6d>(sum.LineBlock(i)) += step.lines[structure.line[i]];
  }
  for (size_t i = 0; i < structure.extra.size(); ++i) {
    if (structure.extra[i] < 0) continue;
    const StateBlock block{BlockKind::kExtra, static_cast<int>(i)};
    AddInTangentSpace(step.extra[structure.extra[i]], state.ManifoldOf(block), state.ExtraBlock(i),
                      sum.ExtraBlock(i));
  }
  return sum;
}

WindowState TakeStep(const BlockStructure& structure, const WindowState& state,
                     const WindowStep& step) {
  WindowState after = Plus(structure, state, step);
  KeepInFront<1>(
      structure.point_observations, structure.point, state,
      [](auto* s, size_t i) { return s->PointBlock(i); }, &after);
  KeepInFront<2>(
      structure.line_observations, structure.line, state,
      [](auto* s, size_t i) { return s->LineBlock(i); }, &after);
  KeepDirections(structure, state, &after);
  return after;
}

}  // namespace msc_vo
