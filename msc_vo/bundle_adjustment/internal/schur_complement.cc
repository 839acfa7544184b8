// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/schur_complement.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// As Ceres bounds the diagonal: a number that nothing observes is damped, and stays.
constexpr double kMinDiagonal = 1e-6, kMaxDiagonal = 1e32;

template <int N>
Eigen::Matrix<double, N, 1> Damping(const Eigen::Matrix<double, N, N>& hessian, double radius) {
  return hessian.diagonal().cwiseMax(kMinDiagonal).cwiseMin(kMaxDiagonal) / radius;
}

// What binds a block of N numbers x to one kept direction: d2 cost / d direction dx.
template <int N>
struct DirectionLink {
  int direction;  // number of the kept line
  Eigen::Matrix<double, 2, N> coupling;
};

// An eliminated block of N numbers x: H x = -(gradient + sum W_i^T y_i) over what it is bound to.
template <int N>
struct Eliminated {
  Eigen::Matrix<double, N, N> inverse;  // of its damped Hessian H
  Eigen::Matrix<double, N, 1> gradient;
  // W_i of its poses, and their numbers.
  const Eigen::Matrix<double, 6, N>* couplings;
  const int* poses;
  int num_poses;
};

// Coordinates of a line in which its direction is apart: four eliminated ones (translation, half
// the growth of its length), then two across its direction. Orthonormal columns.
Matrix6d LineBasis(const Eigen::Vector3d& direction) {
  const double half = std::sqrt(0.5);
  const Eigen::Vector3d across = direction.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << direction, across, direction.cross(across);
  Matrix6d basis;
  basis.topLeftCorner<3, 3>().setIdentity();
  basis.bottomLeftCorner<3, 3>().setIdentity();
  basis.topRightCorner<3, 3>() = -axes;
  basis.bottomRightCorner<3, 3>() = axes;
  return half * basis;
}

class SchurSolver {
 public:
  SchurSolver(const WindowStructure& structure, const WindowEquations& equations, double radius)
      : structure_(structure), equations_(equations), radius_(radius) {}

  bool Solve(WindowStep* step) {
    Eliminate();
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(reduced_);
    if (right_.size() > 0 && cholesky.info() != Eigen::Success) return false;
    step->reduced = right_.size() > 0 ? cholesky.solve(right_) : right_;
    SubstituteBack(step);
    step->model_decrease = ModelDecrease(*step);
    return std::isfinite(step->model_decrease);
  }

  bool Invert(const ChosenUnknowns& chosen, InverseBlocks* inverse) {
    Eliminate();
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(reduced_);
    if (right_.size() > 0 && cholesky.info() != Eigen::Success) return false;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(right_.size(), right_.size());
    inverse_ = right_.size() > 0 ? cholesky.solve(identity).eval() : identity;
    for (const int i : chosen.poses) inverse->poses.push_back(inverse_.block<6, 6>(6 * i, 6 * i));
    for (const int i : chosen.points) inverse->points.push_back(Inverse<3>(points_[i], {}));
    for (const int i : chosen.lines) inverse->lines.push_back(InverseOfLine(i));
    return true;
  }

 private:
  // A line whose direction stays.
  struct ReducedLine {
    Matrix6d basis;
    std::vector<Eigen::Matrix<double, 6, 4>> poses;
    Eliminated<4> position;
    std::vector<DirectionLink<4>> own_direction;

    // How E - S moves with the direction's two numbers.
    Eigen::Matrix<double, 3, 2> Across() const {
      return basis.bottomRightCorner<3, 2>() - basis.topRightCorner<3, 2>();
    }
  };

  // The normal equations without the eliminated numbers: reduced_ x = right_.
  void Eliminate() {
    const int size = DirectionOffset(structure_.num_reduced_lines);
    reduced_.setZero(size, size);
    right_.setZero(size);
    AddPoses();
    EliminatePoints();
    AddCouplings();
    EliminateLines();
  }

  int DirectionOffset(int kept) const { return 6 * structure_.num_poses + 2 * kept; }

  void AddPoses() {
    for (int i = 0; i < structure_.num_poses; ++i) {
      const Matrix6d& h = equations_.pose_hessian[i];
      reduced_.block<6, 6>(6 * i, 6 * i) = h;
      reduced_.diagonal().segment<6>(6 * i) += Damping<6>(h, radius_);
      right_.segment<6>(6 * i) = -equations_.pose_gradient[i];
    }
  }

  // Subtracts W H^-1 W^T from the reduced system; its lower triangle is enough.
  template <int N>
  void Eliminate(const Eliminated<N>& block, const std::vector<DirectionLink<N>>& directions) {
    const Eigen::Matrix<double, N, 1> x = block.inverse * block.gradient;
    for (int a = 0; a < block.num_poses; ++a) {
      const int row = 6 * block.poses[a];
      const Eigen::Matrix<double, 6, N> y = block.couplings[a] * block.inverse;
      right_.segment<6>(row).noalias() += block.couplings[a] * x;
      for (int b = 0; b < block.num_poses; ++b) {
        if (block.poses[b] > block.poses[a]) continue;
        reduced_.block<6, 6>(row, 6 * block.poses[b]).noalias() -=
            y.lazyProduct(block.couplings[b].transpose());
      }
    }
    for (const DirectionLink<N>& a : directions) {
      const int row = DirectionOffset(a.direction);
      const Eigen::Matrix<double, 2, N> y = a.coupling * block.inverse;
      right_.segment<2>(row).noalias() += a.coupling * x;
      for (int b = 0; b < block.num_poses; ++b) {
        reduced_.block<2, 6>(row, 6 * block.poses[b]).noalias() -=
            y.lazyProduct(block.couplings[b].transpose());
      }
      for (const DirectionLink<N>& b : directions) {
        if (b.direction > a.direction) continue;
        reduced_.block<2, 2>(row, DirectionOffset(b.direction)).noalias() -=
            y.lazyProduct(b.coupling.transpose());
      }
    }
  }

  void EliminatePoints() {
    points_.resize(structure_.num_points);
    for (int i = 0; i < structure_.num_points; ++i) {
      Eigen::Matrix3d h = equations_.points.hessian[i];
      h.diagonal() += Damping<3>(h, radius_);
      const LinkRange& links = structure_.point_links[i];
      points_[i] = {h.llt().solve(Eigen::Matrix3d::Identity()), equations_.points.gradient[i],
                    equations_.points.poses.data() + links.begin,
                    structure_.point_link_poses.data() + links.begin, links.size};
      Eliminate<3>(points_[i], {});
    }
  }

  // Pairs of two kept lines bind their directions; of one kept and one eliminated, that line to the
  // direction.
  void AddCouplings() {
    kept_.resize(structure_.num_reduced_lines);
    for (int i = 0; i < structure_.num_lines; ++i) {
      const int kept = structure_.reduced_line[i];
      if (kept >= 0) kept_[kept].basis = LineBasis(equations_.directions[i]);
    }
    line_directions_.assign(structure_.num_lines, {});
    for (size_t k = 0; k < structure_.couplings.size(); ++k) {
      auto [a, b] = structure_.couplings[k];
      Eigen::Matrix3d h = equations_.couplings[k];
      if (structure_.reduced_line[a] < structure_.reduced_line[b]) {
        std::swap(a, b);
        h.transposeInPlace();
      }
      const int kept_a = structure_.reduced_line[a], kept_b = structure_.reduced_line[b];
      const Eigen::Matrix<double, 2, 3> h_a = kept_[kept_a].Across().transpose() * h;
      if (kept_b >= 0) {
        reduced_.block<2, 2>(DirectionOffset(kept_a), DirectionOffset(kept_b)) +=
            h_a * kept_[kept_b].Across();
      } else {
        Eigen::Matrix<double, 2, 6> coupling;
        coupling << -h_a, h_a;
        line_directions_[b].push_back({kept_a, coupling});
      }
    }
  }

  void EliminateLines() {
    lines_.resize(structure_.num_lines);
    for (int i = 0; i < structure_.num_lines; ++i) {
      Matrix6d h = equations_.lines.hessian[i];
      h.diagonal() += Damping<6>(h, radius_);
      const LinkRange& links = structure_.line_links[i];
      lines_[i] = {Matrix6d::Zero(), equations_.lines.gradient[i],
                   equations_.lines.poses.data() + links.begin,
                   structure_.line_link_poses.data() + links.begin, links.size};
      if (structure_.reduced_line[i] >= 0) {
        EliminatePosition(lines_[i], h, structure_.reduced_line[i]);
      } else {
        lines_[i].inverse = h.llt().solve(Matrix6d::Identity());
        Eliminate<6>(lines_[i], line_directions_[i]);
      }
    }
  }

  void EliminatePosition(const Eliminated<6>& line, const Matrix6d& hessian, int number) {
    ReducedLine& kept = kept_[number];
    const Matrix6d h = kept.basis.transpose() * hessian * kept.basis;
    const Vector6d g = kept.basis.transpose() * line.gradient;
    const int row = DirectionOffset(number);
    reduced_.block<2, 2>(row, row) += h.bottomRightCorner<2, 2>();
    right_.segment<2>(row) -= g.tail<2>();
    kept.poses.resize(line.num_poses);
    for (int k = 0; k < line.num_poses; ++k) {
      const Matrix6d w = line.couplings[k] * kept.basis;
      kept.poses[k] = w.leftCols<4>();
      reduced_.block<2, 6>(row, 6 * line.poses[k]) += w.rightCols<2>().transpose();
    }
    kept.own_direction = {{number, h.bottomLeftCorner<2, 4>()}};
    kept.position = {h.topLeftCorner<4, 4>().llt().solve(Eigen::Matrix4d::Identity()), g.head<4>(),
                     kept.poses.data(), line.poses, line.num_poses};
    Eliminate<4>(kept.position, kept.own_direction);
  }

  // x = -H^-1 (gradient + sum W_i^T y_i), y: the reduced unknowns.
  template <int N>
  Eigen::Matrix<double, N, 1> Substitute(const Eliminated<N>& block,
                                         const std::vector<DirectionLink<N>>& directions,
                                         const Eigen::VectorXd& reduced) const {
    Eigen::Matrix<double, N, 1> right = block.gradient;
    for (int a = 0; a < block.num_poses; ++a) {
      right.noalias() += block.couplings[a].transpose() * reduced.segment<6>(6 * block.poses[a]);
    }
    for (const DirectionLink<N>& a : directions) {
      right.noalias() += a.coupling.transpose() * reduced.segment<2>(DirectionOffset(a.direction));
    }
    return -(block.inverse * right);
  }

  void SubstituteBack(WindowStep* step) const {
    step->points.resize(structure_.num_points);
    for (int i = 0; i < structure_.num_points; ++i) {
      step->points[i] = Substitute<3>(points_[i], {}, step->reduced);
    }
    step->lines.resize(structure_.num_lines);
    for (int i = 0; i < structure_.num_lines; ++i) {
      const int number = structure_.reduced_line[i];
      if (number < 0) {
        step->lines[i] = Substitute<6>(lines_[i], line_directions_[i], step->reduced);
        continue;
      }
      const ReducedLine& kept = kept_[number];
      step->lines[i] =
          kept.basis.leftCols<4>() *
              Substitute<4>(kept.position, kept.own_direction, step->reduced) +
          kept.basis.rightCols<2>() * step->reduced.segment<2>(DirectionOffset(number));
    }
  }

  // H^-1 W^T of an eliminated block, over all reduced unknowns.
  template <int N>
  Eigen::Matrix<double, N, Eigen::Dynamic> Influence(
      const Eliminated<N>& block, const std::vector<DirectionLink<N>>& directions) const {
    Eigen::Matrix<double, N, Eigen::Dynamic> influence =
        Eigen::Matrix<double, N, Eigen::Dynamic>::Zero(N, right_.size());
    for (int a = 0; a < block.num_poses; ++a) {
      influence.template middleCols<6>(6 * block.poses[a]) +=
          block.inverse * block.couplings[a].transpose();
    }
    for (const DirectionLink<N>& a : directions) {
      influence.template middleCols<2>(DirectionOffset(a.direction)) +=
          block.inverse * a.coupling.transpose();
    }
    return influence;
  }

  // H^-1 + H^-1 W^T S^-1 W H^-1, S the reduced system.
  template <int N>
  Eigen::Matrix<double, N, N> Inverse(const Eliminated<N>& block,
                                      const std::vector<DirectionLink<N>>& directions) const {
    const Eigen::Matrix<double, N, Eigen::Dynamic> influence = Influence<N>(block, directions);
    return block.inverse + influence * inverse_ * influence.transpose();
  }

  Matrix6d InverseOfLine(int i) const {
    const int number = structure_.reduced_line[i];
    if (number < 0) return Inverse<6>(lines_[i], line_directions_[i]);
    const ReducedLine& kept = kept_[number];
    const int row = DirectionOffset(number);
    Matrix6d inverse;  // of position, then direction
    inverse.topLeftCorner<4, 4>() = Inverse<4>(kept.position, kept.own_direction);
    inverse.topRightCorner<4, 2>() =
        -Influence<4>(kept.position, kept.own_direction) * inverse_.middleCols<2>(row);
    inverse.bottomLeftCorner<2, 4>() = inverse.topRightCorner<4, 2>().transpose();
    inverse.bottomRightCorner<2, 2>() = inverse_.block<2, 2>(row, row);
    return kept.basis * inverse * kept.basis.transpose();
  }

  // -g^T x - x^T H x / 2, where H x = -g - D x / radius.
  double ModelDecrease(const WindowStep& step) const {
    double sum = 0.0;
    const auto add = [&](const auto& hessian, const auto& gradient, const auto& x) {
      constexpr int kSize = std::decay_t<decltype(hessian)>::RowsAtCompileTime;
      sum += x.dot(Damping<kSize>(hessian, radius_).cwiseProduct(x) - gradient);
    };
    for (int i = 0; i < structure_.num_poses; ++i) {
      add(equations_.pose_hessian[i], equations_.pose_gradient[i],
          Vector6d(step.reduced.segment<6>(6 * i)));
    }
    for (int i = 0; i < structure_.num_points; ++i) {
      add(equations_.points.hessian[i], equations_.points.gradient[i], step.points[i]);
    }
    for (int i = 0; i < structure_.num_lines; ++i) {
      add(equations_.lines.hessian[i], equations_.lines.gradient[i], step.lines[i]);
    }
    return 0.5 * sum;
  }

  const WindowStructure& structure_;
  const WindowEquations& equations_;
  double radius_;
  Eigen::MatrixXd reduced_;  // lower triangle
  Eigen::VectorXd right_;
  std::vector<Eliminated<3>> points_;
  std::vector<Eliminated<6>> lines_;
  std::vector<std::vector<DirectionLink<6>>> line_directions_;  // of the eliminated lines
  std::vector<ReducedLine> kept_;
  Eigen::MatrixXd inverse_;  // of the reduced system
};

}  // namespace

bool SolveStep(const WindowStructure& structure, const WindowEquations& equations, double radius,
               WindowStep* step) {
  return SchurSolver(structure, equations, radius).Solve(step);
}

bool InvertBlocks(const WindowStructure& structure, const WindowEquations& equations, double radius,
                  const ChosenUnknowns& chosen, InverseBlocks* inverse) {
  return SchurSolver(structure, equations, radius).Invert(chosen, inverse);
}

WindowState Moved(const WindowStructure& structure, const WindowState& state,
                  const WindowStep& step) {
  WindowState moved = state;
  for (size_t i = 0; i < structure.pose.size(); ++i) {
    if (structure.pose[i] < 0) continue;
    Rigid3Manifold().Plus(state.PoseBlock(i), &step.reduced[6 * structure.pose[i]],
                          moved.PoseBlock(i));
  }
  for (size_t i = 0; i < structure.point.size(); ++i) {
    if (structure.point[i] < 0) continue;
    Eigen::Map<Eigen::Vector3d>(moved.PointBlock(i)) += step.points[structure.point[i]];
  }
  for (size_t i = 0; i < structure.line.size(); ++i) {
    if (structure.line[i] < 0) continue;
    Eigen::Map<Vector6d>(moved.LineBlock(i)) += step.lines[structure.line[i]];
  }
  return moved;
}

}  // namespace msc_vo
