// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_equations.h"

#include <cmath>
#include <type_traits>

#include "msc_vo/factors/camera_equations.h"

namespace msc_vo {

namespace {

using Pose = WindowEquations::Pose;

// Data that all observations of one kind of landmark share.
template <int Points>
struct ObservationTerms {
  HuberLoss reprojection_loss, depth_loss;
  const std::vector<int>& unknown;  // number of each landmark of the data
  WindowEquations::Landmarks<3 * Points>* equations;
};

class Linearizer {
 public:
  Linearizer(const BlockStructure& structure, const WindowTerms& terms, const WindowState& state,
             WindowEquations* equations)
      : structure_(structure), terms_(terms), state_(state), equations_(equations) {}

  bool Run() {
    SetZero();
    for (size_t i = 0; i < structure_.pose.size(); ++i) {
      rotations_.push_back(state_.Pose(i).rotation().toRotationMatrix());
    }
    const ObservationTerms<1> points{terms_.Of<PointReprojection>().loss,
                                     terms_.Of<DepthReprojection>().loss, structure_.point,
                                     &equations_->points};
    const ObservationTerms<2> lines{terms_.Of<LineReprojection>().loss,
                                    terms_.Of<LineDepthReprojection>().loss, structure_.line,
                                    &equations_->lines};
    for (const PointObservationFactors& o : structure_.point_observations) {
      if (!AddObservation(points, o, state_.PointBlock(o.landmark))) return false;
    }
    for (const LineObservationFactors& o : structure_.line_observations) {
      if (!AddObservation(lines, o, state_.LineBlock(o.landmark))) return false;
    }
    if (!ComputeDirections()) return false;
    bool defined = true;
    ForEachTerm(terms_, [&](const auto&, const auto& blocks) { defined = defined && Add(blocks); });
    return defined && std::isfinite(equations_->cost);
  }

 private:
  template <int N>
  static void SetZero(int count, int num_couplings, WindowEquations::Landmarks<N>* landmarks) {
    using Landmarks = WindowEquations::Landmarks<N>;
    landmarks->hessian.assign(count, Landmarks::Block::Zero());
    landmarks->gradient.assign(count, Landmarks::Vector::Zero());
    landmarks->pose_couplings.assign(num_couplings, Landmarks::Coupling::Zero());
  }
  void SetZero() {
    equations_->cost = 0.0;
    equations_->pose_hessian.assign(structure_.num_poses, Pose::Block::Zero());
    equations_->pose_gradient.assign(structure_.num_poses, Pose::Vector::Zero());
    SetZero(structure_.num_points, static_cast<int>(structure_.point_blocks.pose.size()),
            &equations_->points);
    SetZero(structure_.num_lines, static_cast<int>(structure_.line_blocks.pose.size()),
            &equations_->lines);
    equations_->line_couplings.clear();
    equations_->line_couplings.reserve(structure_.line_pairs.size());
    equations_->custom_couplings.clear();
    SetExtraZero();
    rotations_.clear();
  }

  void SetExtraZero() {
    equations_->extra_hessian.clear();
    equations_->extra_gradient.clear();
    for (const int size : structure_.extra_size) {
      equations_->extra_hessian.push_back(Eigen::MatrixXd::Zero(size, size));
      equations_->extra_gradient.push_back(Eigen::VectorXd::Zero(size));
    }
  }

  template <int Points, typename Observation>
  bool AddObservation(const ObservationTerms<Points>& terms, const Observation& o,
                      const double* landmark) {
    const Eigen::Matrix3d& rotation = rotations_[o.keyframe];
    const Eigen::Map<const Eigen::Vector3d> translation(state_.PoseBlock(o.keyframe) + 4);
    CameraPoints<Points> points;
    if (!points.Set(o, rotation, translation, landmark)) return false;
    CameraEquations<Points> at;
    if (o.reprojection != nullptr) at.Add(*o.reprojection, terms.reprojection_loss, points);
    if (o.depth != nullptr) at.Add(*o.depth, terms.depth_loss, points);
    equations_->cost += at.cost;
    const int unknown = terms.unknown[o.landmark], pose = structure_.pose[o.keyframe];
    typename CameraEquations<Points>::Blocks blocks;
    if (unknown >= 0) {
      blocks.landmark_hessian = &terms.equations->hessian[unknown];
      blocks.landmark_gradient = &terms.equations->gradient[unknown];
    }
    if (pose >= 0) {
      blocks.pose_hessian = &equations_->pose_hessian[pose];
      blocks.pose_gradient = &equations_->pose_gradient[pose];
    }
    if (o.block >= 0) blocks.coupling = &terms.equations->pose_couplings[o.block];
    at.AddTo(blocks, o, rotation, points);
    return true;
  }

  // Computes the directions of all constrained lines once, as a line is part of many pairs. Returns
  // false if a line has zero length.
  bool ComputeDirections() {
    equations_->directions.resize(structure_.num_lines);
    directions_.resize(structure_.line.size());
    for (size_t i = 0; i < structure_.line.size(); ++i) {
      if (!terms_.line_constrained[i]) continue;
      if (!LineDirection(state_.LineBlock(i), &directions_[i].unit)) return false;
      directions_[i].jacobian = LineDirectionJacobian(state_.LineBlock(i));
      if (structure_.line[i] >= 0) {
        equations_->directions[structure_.line[i]] = directions_[i].unit;
      }
    }
    return true;
  }

  // Observations are added with all of their factors at once (AddObservation).
  template <typename Factor>
  std::enable_if_t<kIsOfObservation<Factor>, bool> Add(const WindowTerm<Factor>&) {
    return true;
  }

  bool Add(const WindowTerm<LineEndpointPrior>& term) {
    for (const auto& block : term.blocks) {
      const auto [line] = block.parameters;
      const int unknown = structure_.line[line];
      Eigen::Vector2d r;
      block.factor(state_.LineBlock(line), r.data());
      equations_->cost += 0.5 * r.squaredNorm();
      for (int k = 0; k < 2; ++k) {
        const Eigen::Vector3d j = block.factor.Jacobian();
        equations_->lines.hessian[unknown].block<3, 3>(3 * k, 3 * k) += j * j.transpose();
        equations_->lines.gradient[unknown].segment<3>(3 * k) += r[k] * j;
      }
    }
    return true;
  }

  // Adds derivatives with respect to E - S to those of a line.
  void AddToLine(int unknown, const Eigen::Matrix3d& hessian, const Eigen::Vector3d& gradient) {
    WindowEquations::Landmarks<6>::Block& h = equations_->lines.hessian[unknown];
    h.topLeftCorner<3, 3>() += hessian;
    h.topRightCorner<3, 3>() -= hessian;
    h.bottomLeftCorner<3, 3>() -= hessian;
    h.bottomRightCorner<3, 3>() += hessian;
    equations_->lines.gradient[unknown].head<3>() -= gradient;
    equations_->lines.gradient[unknown].tail<3>() += gradient;
  }

  bool Add(const WindowTerm<ManhattanAxisAlignment>& term) {
    for (const auto& block : term.blocks) {
      const auto [line] = block.parameters;
      Eigen::Vector2d r;
      const Direction& d = directions_[line];
      block.factor.Residual(d.unit, r.data());
      const double s = r.squaredNorm();
      const double weight = term.loss.Weight(s);
      equations_->cost += 0.5 * term.loss.Cost(s);
      const Eigen::Matrix<double, 2, 3> j = block.factor.Jacobian() * d.jacobian;
      AddToLine(structure_.line[line], weight * j.transpose() * j, weight * j.transpose() * r);
    }
    return true;
  }

  template <typename Factor>
  std::enable_if_t<kRelatesLines<Factor>, bool> Add(const WindowTerm<Factor>& term) {
    for (const auto& block : term.blocks) {
      const auto [line_i, line_j] = block.parameters;
      const Direction &d_i = directions_[line_i], &d_j = directions_[line_j];
      Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
      block.factor.Residual(d_i.unit, d_j.unit, r.data());
      const double s = r.squaredNorm();
      const double weight = block.count * term.loss.Weight(s);
      equations_->cost += 0.5 * (block.count * term.loss.Cost(s));
      const typename Factor::Jacobian by_i =
          block.factor.JacobianI(d_i.unit, d_j.unit) * d_i.jacobian;
      const typename Factor::Jacobian by_j =
          block.factor.JacobianJ(d_i.unit, d_j.unit) * d_j.jacobian;
      const int i = structure_.line[line_i], j = structure_.line[line_j];
      if (i >= 0) AddToLine(i, weight * by_i.transpose() * by_i, weight * by_i.transpose() * r);
      if (j >= 0) AddToLine(j, weight * by_j.transpose() * by_j, weight * by_j.transpose() * r);
      if (i >= 0 && j >= 0) equations_->line_couplings.push_back(weight * by_i.transpose() * by_j);
    }
    return true;
  }

  bool Add(const WindowTerm<PosePrior>& term) {
    for (const auto& block : term.blocks) {
      const auto [keyframe] = block.parameters;
      const int pose = structure_.pose[keyframe];
      Pose::Vector r;
      block.factor(state_.PoseBlock(keyframe), r.data());
      const Pose::Block j = block.factor.TangentJacobian(state_.Pose(keyframe));
      equations_->cost += 0.5 * r.squaredNorm();
      equations_->pose_hessian[pose] += j.transpose() * j;
      equations_->pose_gradient[pose] += j.transpose() * r;
    }
    return true;
  }

  bool Add(const WindowTerm<CustomFactor>& term) {
    CustomLinearization at;
    for (size_t i = 0; i < term.blocks.size(); ++i) {
      const std::vector<StateBlock>& unknowns = structure_.custom_factors[i];
      const CustomFactor& factor = *term.blocks[i].factor;
      std::vector<CustomParameter> parameters = ParametersOf(term.blocks[i], state_);
      for (size_t a = 0; a < unknowns.size(); ++a) {
        parameters[a].variable = unknowns[a].position >= 0;
      }
      if (!LinearizeCustomFactor(*factor.cost, factor.loss.get(), parameters, &at)) return false;
      equations_->cost += at.cost;
      for (size_t a = 0; a < unknowns.size(); ++a) {
        if (!parameters[a].variable) continue;
        const Eigen::MatrixXd& j = at.jacobians[a];
        AddToUnknown(unknowns[a], j.transpose() * j, j.transpose() * at.residual);
        for (size_t b = 0; b < a; ++b) {
          if (!parameters[b].variable) continue;
          equations_->custom_couplings.push_back(
              {unknowns[a], unknowns[b], j.transpose() * at.jacobians[b]});
        }
      }
    }
    return true;
  }

  void AddToUnknown(const StateBlock& unknown, const Eigen::MatrixXd& hessian,
                    const Eigen::VectorXd& gradient) {
    const int i = unknown.position;
    const auto add = [&](auto& sum_hessian, auto& sum_gradient) {
      sum_hessian[i] += hessian;
      sum_gradient[i] += gradient;
    };
    switch (unknown.kind) {
      case BlockKind::kPose:
        return add(equations_->pose_hessian, equations_->pose_gradient);
      case BlockKind::kPoint:
        return add(equations_->points.hessian, equations_->points.gradient);
      case BlockKind::kLine:
        return add(equations_->lines.hessian, equations_->lines.gradient);
      case BlockKind::kAxes:
      case BlockKind::kExtra:
        return add(equations_->extra_hessian, equations_->extra_gradient);
    }
  }

  const BlockStructure& structure_;
  const WindowTerms& terms_;
  const WindowState& state_;
  WindowEquations* equations_;
  struct Direction {
    Eigen::Vector3d unit;
    Eigen::Matrix3d jacobian;  // d unit / d(E - S)
  };
  std::vector<Eigen::Matrix3d> rotations_;  // of all keyframes
  std::vector<Direction> directions_;       // of all lines
};

}  // namespace

bool Linearize(const BlockStructure& structure, const WindowTerms& terms, const WindowState& state,
               WindowEquations* equations) {
  return Linearizer(structure, terms, state, equations).Run();
}

}  // namespace msc_vo
