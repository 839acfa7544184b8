// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The Schur complement, its back substitution and covariance blocks against dense linear algebra.

#include "msc_vo/bundle_adjustment/internal/window_step.h"

#include "tests/support/factor_checks.h"
#include "tests/support/test_window.h"
#include <Eigen/LU>

#include "msc_vo/bundle_adjustment/internal/covariance_blocks.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {
namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// The normal equations as one dense system: poses (6 each), points (3), lines (6).
struct DenseEquations {
  DenseEquations(const BlockStructure& structure, const WindowEquations& equations)
      : points(6 * structure.num_poses), lines(points + 3 * structure.num_points) {
    const int size = lines + 6 * structure.num_lines;
    hessian.setZero(size, size);
    gradient.setZero(size);
    for (int i = 0; i < structure.num_poses; ++i) {
      hessian.block<6, 6>(6 * i, 6 * i) = equations.pose_hessian[i];
      gradient.segment<6>(6 * i) = equations.pose_gradient[i];
    }
    AddLandmarks(equations.points, structure.point_blocks, points);
    AddLandmarks(equations.lines, structure.line_blocks, lines);
    for (size_t k = 0; k < structure.line_pairs.size(); ++k) {
      // d(E - S) / d(S, E) = (-I, I).
      Eigen::Matrix<double, 3, 6> difference;
      difference << -Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
      const Matrix6d h = difference.transpose() * equations.line_couplings[k] * difference;
      const auto [a, b] = structure.line_pairs[k];
      const int row = lines + 6 * std::max(a, b), column = lines + 6 * std::min(a, b);
      hessian.block<6, 6>(row, column) += a > b ? h : Matrix6d(h.transpose());
    }
    hessian = Eigen::MatrixXd(hessian.selfadjointView<Eigen::Lower>());
  }

  Eigen::MatrixXd Damped(double radius) const {
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() += hessian.diagonal().cwiseMax(1e-6) / radius;
    return damped;
  }

  int points, lines;  // first rows
  Eigen::MatrixXd hessian;
  Eigen::VectorXd gradient;

 private:
  template <int N>
  void AddLandmarks(const WindowEquations::Landmarks<N>& landmarks,
                    const PoseLandmarkBlocks& blocks, int first_row) {
    for (size_t i = 0; i < landmarks.hessian.size(); ++i) {
      const int row = first_row + N * static_cast<int>(i);
      hessian.block<N, N>(row, row) = landmarks.hessian[i];
      gradient.segment<N>(row) = landmarks.gradient[i];
      const PoseLandmarkBlocks::Range& range = blocks.of_landmark[i];
      for (int k = range.begin; k < range.end(); ++k) {
        hessian.block<N, 6>(row, 6 * blocks.pose[k]) = landmarks.pose_couplings[k].transpose();
      }
    }
  }
};

// Parameter: radius of the trust region.
class WindowStepTest : public ::testing::TestWithParam<double> {
 protected:
  WindowStepTest() {
    TestWindowOptions scene;
    scene.num_keyframes = 5;
    scene.num_points = 20;
    scene.num_lines = 12;
    data_ = MakeTestWindow(scene).data;
    data_.points[3].fixed = data_.lines[7].fixed = true;
    // A clique, a star, a fixed partner, and lines without pairs.
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) AddPair(i, j);
    }
    for (int i = 5; i < 9; ++i) AddPair(i, 4);
    data_.axis_alignments.push_back({data_.lines[9].id, Eigen::Vector3d::UnitX(), 0.02});

    const WindowIndex index = ValidateWindow(options_, data_);
    int num_behind = 0;
    const WindowState state(data_);
    terms_ = MakeWindowTerms(options_, data_, index,
                             InitialInlierMask(options_, index, data_, &num_behind), state);
    structure_ = std::make_unique<BlockStructure>(data_, terms_, state);
    EXPECT_TRUE(Linearize(*structure_, terms_, state, &equations_));
    dense_ = std::make_unique<DenseEquations>(*structure_, equations_);
  }
  void AddPair(int i, int j) {
    (i % 3 == j % 3 ? data_.parallel_pairs : data_.perpendicular_pairs)
        .push_back({data_.lines[i].id, data_.lines[j].id, 0.02});
  }

  BundleAdjustmentOptions options_;
  WindowData data_;
  WindowTerms terms_;
  std::unique_ptr<BlockStructure> structure_;
  WindowEquations equations_;
  std::unique_ptr<DenseEquations> dense_;
};
INSTANTIATE_TEST_SUITE_P(Radius, WindowStepTest, ::testing::Values(1e4, 1.0));

TEST_P(WindowStepTest, NumbersFreeItemsOnly) {
  EXPECT_EQ(structure_->num_poses, 3);
  EXPECT_EQ(structure_->num_points, 19);
  EXPECT_EQ(structure_->num_lines, 11);
  EXPECT_EQ(structure_->point[3], -1);
  EXPECT_EQ(structure_->point[4], 3);
  EXPECT_EQ(structure_->line[7], -1);
  EXPECT_EQ(structure_->line_pairs.size(), 6u + 3u);  // without the pair with fixed line 7
  EXPECT_EQ(structure_->num_reduced_lines, 3 + 1);
}

TEST_P(WindowStepTest, GradientMatchesNumericDerivative) {
  const WindowState state(data_);
  WindowStep step;
  step.points.assign(structure_->num_points, Eigen::Vector3d::Zero());
  step.lines.assign(structure_->num_lines, Eigen::Matrix<double, 6, 1>::Zero());
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6 * structure_->num_poses; ++i) {
    const auto cost = [&](double delta) {
      step.reduced.setZero(6 * structure_->num_poses);
      step.reduced[i] = delta;
      return Cost(terms_, Plus(*structure_, state, step));
    };
    const double numeric = (cost(kStep) - cost(-kStep)) / (2.0 * kStep);
    EXPECT_NEAR(dense_->gradient[i], numeric, 1e-5 * dense_->gradient.norm()) << i;
  }
}

TEST_P(WindowStepTest, ResetsOnlyALineOfZeroLength) {
  // Line 0 is part of pairs, line 9 of an alignment, line 10 of neither.
  for (const int collapsed : {0, 9, 10}) {
    SCOPED_TRACE(collapsed);
    const WindowState state(data_);
    WindowStep step;
    step.reduced.setConstant(6 * structure_->num_poses, 1e-4);
    step.points.assign(structure_->num_points, Eigen::Vector3d::Constant(1e-3));
    step.lines.assign(structure_->num_lines, Eigen::Matrix<double, 6, 1>::Constant(1e-3));
    const LineSegment3 line = state.Line(collapsed);
    step.lines[structure_->line[collapsed]] << Eigen::Vector3d::Zero(), line.start - line.end;
    const WindowState after = TakeStep(*structure_, state, step);
    EXPECT_EQ(after.Line(collapsed).start, line.start);
    EXPECT_EQ(after.Line(collapsed).end, line.end);
    EXPECT_GT((after.Point(4) - state.Point(4)).norm(), 1e-4);
    EXPECT_GT((after.Line(1).start - state.Line(1).start).norm(), 1e-4);
    WindowEquations equations;
    EXPECT_TRUE(Linearize(*structure_, terms_, after, &equations));
  }
}

TEST_P(WindowStepTest, StepMatchesDenseSolution) {
  WindowStep step;
  ASSERT_TRUE(SolveStep(*structure_, equations_, GetParam(), &step));
  const Eigen::VectorXd expected = dense_->Damped(GetParam()).lu().solve(-dense_->gradient);
  const double tolerance = 1e-8 * expected.norm();
  EXPECT_THAT(Eigen::VectorXd(step.reduced.head(dense_->points)),
              IsNear(Eigen::VectorXd(expected.head(dense_->points)), tolerance));
  for (int i = 0; i < structure_->num_points; ++i) {
    EXPECT_THAT(step.points[i],
                IsNear(expected.segment<3>(dense_->points + 3 * i).eval(), tolerance))
        << i;
  }
  for (int i = 0; i < structure_->num_lines; ++i) {
    EXPECT_THAT(step.lines[i], IsNear(expected.segment<6>(dense_->lines + 6 * i).eval(), tolerance))
        << i;
  }
  const double decrease =
      -dense_->gradient.dot(expected) - 0.5 * expected.dot(dense_->hessian * expected);
  EXPECT_NEAR(step.model_decrease, decrease, 1e-8 * decrease);
}

TEST_P(WindowStepTest, CovarianceBlocksMatchDenseInverse) {
  UnknownSelection all;
  for (int i = 0; i < structure_->num_poses; ++i) all.poses.push_back(i);
  for (int i = 0; i < structure_->num_points; ++i) all.points.push_back(i);
  for (int i = 0; i < structure_->num_lines; ++i) all.lines.push_back(i);
  CovarianceBlocks blocks;
  ASSERT_TRUE(ComputeCovarianceBlocks(*structure_, equations_, GetParam(), all, &blocks));
  const Eigen::MatrixXd expected = dense_->Damped(GetParam()).inverse();
  const auto expect = [&expected](const auto& block, int row) {
    constexpr int kSize = std::decay_t<decltype(block)>::RowsAtCompileTime;
    const auto dense = expected.block<kSize, kSize>(row, row).eval();
    EXPECT_THAT(block, IsNear(dense, 1e-7 * dense.norm())) << row;
  };
  ASSERT_EQ(blocks.poses.size(), all.poses.size());
  for (const int i : all.poses) expect(blocks.poses[i], 6 * i);
  for (const int i : all.points) expect(blocks.points[i], dense_->points + 3 * i);
  for (const int i : all.lines) expect(blocks.lines[i], dense_->lines + 6 * i);
}

TEST_P(WindowStepTest, FailsIfTheEquationsAreNotPositiveDefinite) {
  equations_.pose_hessian[0] = -Matrix6d::Identity();
  WindowStep step;
  EXPECT_FALSE(SolveStep(*structure_, equations_, GetParam(), &step));
  CovarianceBlocks blocks;
  EXPECT_FALSE(
      ComputeCovarianceBlocks(*structure_, equations_, GetParam(), {{0}, {}, {}}, &blocks));
  EXPECT_TRUE(blocks.poses.empty());
}

}  // namespace
}  // namespace msc_vo
