// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/frame_structure_factors.h"

#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <ceres/jet.h>

#include "msc_vo/bundle_adjustment/levenberg_marquardt.h"
#include "msc_vo/factors/robust_loss.h"

namespace msc_vo {

namespace {

using Block = InverseDepthLineBlock;
using Blocks = std::vector<Block>;
using Matrix = StructureEquations::Matrix;

// Direction of a line and its derivative with respect to its block.
struct Direction {
  Eigen::Vector3d value;
  Eigen::Matrix<double, 3, InverseDepthLine::kBlockSize> jacobian;
};

bool Linearize(const InverseDepthLine& line, const Block& block, Direction* direction) {
  using Jet = ceres::Jet<double, InverseDepthLine::kBlockSize>;
  Jet x[InverseDepthLine::kBlockSize];
  for (int i = 0; i < InverseDepthLine::kBlockSize; ++i) x[i] = Jet(block[i], i);
  Eigen::Matrix<Jet, 3, 1> d;
  if (!line.Direction(x, &d)) return false;
  for (int i = 0; i < 3; ++i) {
    direction->value[i] = d[i].a;
    direction->jacobian.row(i) = d[i].v.transpose();
  }
  return true;
}

void AddPrior(const InverseDepthLinePrior& prior, int line, const Block& block,
              StructureEquations* equations) {
  using Jet = ceres::Jet<double, InverseDepthLine::kBlockSize>;
  Jet x[InverseDepthLine::kBlockSize], rows[InverseDepthLinePrior::kNumResiduals];
  for (int i = 0; i < InverseDepthLine::kBlockSize; ++i) x[i] = Jet(block[i], i);
  prior(x, rows);
  for (const Jet& row : rows) {
    equations->cost += 0.5 * row.a * row.a;
    equations->gradient[line] += row.a * row.v;
    equations->diagonal[line] += row.v * row.v.transpose();
  }
}

template <typename Relation>
void AddPair(const FrameStructureFactors::Pair<Relation>& pair, const HuberLoss& loss,
             const std::vector<Direction>& directions, StructureEquations* equations) {
  constexpr int kRows = Relation::kNumResiduals;
  const Direction& at_i = directions[pair.i];
  const Direction& at_j = directions[pair.j];
  Eigen::Matrix<double, kRows, 1> r;
  pair.relation.Residual(at_i.value, at_j.value, r.data());
  const double s = r.squaredNorm();
  const double weight = loss.Weight(s);
  equations->cost += 0.5 * loss.Cost(s);
  const auto j_i = (pair.relation.JacobianI(at_i.value, at_j.value) * at_i.jacobian).eval();
  const auto j_j = (pair.relation.JacobianJ(at_i.value, at_j.value) * at_j.jacobian).eval();
  equations->gradient[pair.i] += weight * (j_i.transpose() * r);
  equations->gradient[pair.j] += weight * (j_j.transpose() * r);
  equations->pairs.push_back({pair.i, pair.j, weight * (j_i.transpose() * j_i),
                              weight * (j_i.transpose() * j_j), weight * (j_j.transpose() * j_j)});
  equations->diagonal[pair.i] += equations->pairs.back().ii;
  equations->diagonal[pair.j] += equations->pairs.back().jj;
}

double Dot(const Blocks& a, const Blocks& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

// y = J^T J x, with the diagonal blocks multiplied by 1 + lambda.
void Multiply(const StructureEquations& equations, double lambda, const Blocks& x, Blocks* y) {
  y->resize(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    (*y)[i].noalias() = (1.0 + lambda) * (equations.diagonal[i] * x[i]);
  }
  for (const StructureEquations::Pair& pair : equations.pairs) {
    (*y)[pair.i].noalias() += pair.ij * x[pair.j];
    (*y)[pair.j].noalias() += pair.ij.transpose() * x[pair.i];
  }
}

// Solves J^T J x = -J^T r, with the diagonal blocks multiplied by 1 + lambda, by conjugate
// gradients with the block-Jacobi preconditioner.
Blocks SolveStep(const StructureEquations& equations, double lambda) {
  // Relative error 1e-3 of the step in the norm of the preconditioner. Higher accuracy would not
  // reduce the number of steps, because the robust loss prevents quadratic convergence.
  constexpr double kTolerance = 1e-6;
  constexpr int kMaxIterations = 100;  // 10 to 30 suffice, as priors condition the blocks
  std::vector<Matrix> inverse;
  for (const Matrix& block : equations.diagonal) {
    inverse.push_back(((1.0 + lambda) * block).llt().solve(Matrix::Identity()));
  }
  const auto precondition = [&inverse](const Blocks& r, Blocks* z) {
    for (size_t i = 0; i < r.size(); ++i) (*z)[i].noalias() = inverse[i] * r[i];
  };
  Blocks x(equations.gradient.size(), Block::Zero());
  Blocks residual = equations.gradient;
  for (Block& r : residual) r = -r;
  Blocks z(residual.size());
  precondition(residual, &z);
  Blocks p = z;
  Blocks hp;
  double rz = Dot(residual, z);
  const double end = kTolerance * rz;
  for (int iteration = 0; iteration < kMaxIterations && rz > end; ++iteration) {
    Multiply(equations, lambda, p, &hp);
    const double alpha = rz / Dot(p, hp);
    for (size_t i = 0; i < x.size(); ++i) {
      x[i] += alpha * p[i];
      residual[i] -= alpha * hp[i];
    }
    precondition(residual, &z);
    const double next = Dot(residual, z);
    for (size_t i = 0; i < p.size(); ++i) p[i] = z[i] + (next / rz) * p[i];
    rz = next;
  }
  return x;
}

// The unknown blocks and their normal equations, for MinimizeByLevenbergMarquardt.
class StructureProblem {
 public:
  StructureProblem(const FrameStructureFactors& factors, const Blocks& blocks,
                   StructureEquations* equations)
      : factors_(factors), blocks_(blocks), equations_(equations) {}

  const Blocks& blocks() const { return blocks_; }

  bool Linearize() { return factors_.Linearize(blocks_, equations_); }

  bool SolveStep(double lambda, double* squared_step) {
    const Blocks step = msc_vo::SolveStep(*equations_, lambda);
    Multiply(*equations_, 0.0, step, &product_);
    *squared_step = Dot(step, product_);
    candidate_ = blocks_;
    for (size_t i = 0; i < step.size(); ++i) candidate_[i] += step[i];
    return std::isfinite(*squared_step);
  }

  // Derivatives are needed after the last step too: covariances are computed from them.
  bool TakeStep(bool /*is_last*/) {
    if (!factors_.Linearize(candidate_, &next_) || !(next_.cost <= equations_->cost)) return false;
    blocks_.swap(candidate_);
    std::swap(*equations_, next_);
    return true;
  }

 private:
  const FrameStructureFactors& factors_;
  Blocks blocks_, candidate_, product_;
  StructureEquations* equations_;  // at blocks_
  StructureEquations next_;        // at candidate_
};

}  // namespace

bool FrameStructureFactors::Linearize(const Blocks& blocks, StructureEquations* equations) const {
  *equations = StructureEquations();
  equations->gradient.assign(lines.size(), Block::Zero());
  equations->diagonal.assign(lines.size(), Matrix::Zero());
  equations->pairs.reserve(parallel.size() + perpendicular.size());
  const HuberLoss loss{huber};
  std::vector<Direction> directions(lines.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    if (!msc_vo::Linearize(lines[i], blocks[i], &directions[i])) return false;
    AddPrior(priors[i], static_cast<int>(i), blocks[i], equations);
  }
  for (const auto& pair : parallel) AddPair(pair, loss, directions, equations);
  for (const auto& pair : perpendicular) AddPair(pair, loss, directions, equations);
  return std::isfinite(equations->cost);
}

bool MinimizeStructure(const FrameStructureFactors& factors, int max_iterations, Blocks* blocks,
                       StructureEquations* equations) {
  // A hundredth of the estimate's own standard deviations, of all lines together.
  constexpr double kMinSquaredStep = 1e-4;
  StructureProblem problem(factors, *blocks, equations);
  const LevenbergMarquardtSummary summary =
      MinimizeByLevenbergMarquardt(max_iterations, kMinSquaredStep, &problem);
  if (summary.termination == LevenbergMarquardtTermination::kFailed) return false;
  *blocks = problem.blocks();
  return true;
}

std::vector<Matrix> BoundCovariances(const FrameStructureFactors& factors,
                                     const StructureEquations& equations) {
  std::vector<Matrix> priors = equations.diagonal;
  for (const StructureEquations::Pair& pair : equations.pairs) {
    priors[pair.i] -= pair.ii;
    priors[pair.j] -= pair.jj;
  }
  // Information of each line, with its partners eliminated. They are independent of each other
  // given this line, because the pairs among them are neglected.
  std::vector<Matrix> information = priors;
  for (const StructureEquations::Pair& pair : equations.pairs) {
    const Matrix given_j = pair.ij * (priors[pair.j] + pair.jj).llt().solve(pair.ij.transpose());
    const Matrix given_i = pair.ij.transpose() * (priors[pair.i] + pair.ii).llt().solve(pair.ij);
    information[pair.i] += pair.ii - given_j;
    information[pair.j] += pair.jj - given_i;
  }
  std::vector<Matrix> covariances;
  for (size_t i = 0; i < factors.lines.size(); ++i) {
    covariances.push_back(information[i].llt().solve(Matrix::Identity()));
  }
  return covariances;
}

}  // namespace msc_vo
