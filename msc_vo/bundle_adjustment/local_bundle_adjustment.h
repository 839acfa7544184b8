// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// One kind of term of the window: its loss, and whether it takes part. Sigmas belong to the data.
struct TermOptions {
  bool enabled = true;
  double huber = 2.0;  // sigmas; where the loss turns from square to linear
};

// What is learnt of single landmarks (LearnLandmarkNoise).
struct LandmarkNoiseOptions {
  // Off where sigmas are the caller's word, and covariances are to stand on them: what is learnt
  // from a few residuals says too little of its own error. The mapper has it on.
  bool enabled = false;
  // Residuals that a noise of 1 counts as, before any are seen: the degrees of freedom of Student's
  // distribution. With 1, 2 and 3 the geometric mean of the errors of the ten rendered sequences
  // was 0.78, 0.74 and 0.76 mm; before offsets of depth 0.81 with 2, 0.84 with 5 and 1.09 without.
  double prior = 2.0;
  // Metres, of what the depths of a line are off in all views alike: the thickness of a door's
  // casing, a rounded edge. With 0.0025, 0.004 and 0.006 the geometric mean of the errors of the
  // ten rendered sequences was 0.81, 0.74 and 0.75 mm, without 0.81.
  double depth_offset_sigma = 0.005;

  bool IsValid(std::string* error) const;
};

// What minimises the sum of factors. All go the same way, to the same minimum.
enum class BundleAdjustmentSolver {
  kBlockSchur,       // linear algebra made for the window: by far the fastest
  kCeresDenseSchur,  // Ceres: the reference
  // The same with sparse matrices, of the library that Ceres must have been built with.
  kCeresSuiteSparse,
  kCeresEigenSparse,
};

struct BundleAdjustmentOptions {
  BundleAdjustmentSolver solver = BundleAdjustmentSolver::kBlockSchur;
  // Of the Ceres solvers; off: derivatives are automatic, and the order of elimination is Ceres's.
  // For comparison.
  bool analytic_jacobians = true;
  bool explicit_ordering = true;

  // Huber thresholds: square root of the 95 % chi-square quantile with the term's number of rows
  // (2 rows 5.991, 1 row 3.841), so that 5 % of good residuals feel the loss.
  TermOptions point_reprojection{true, 2.448};
  TermOptions point_depth{true, 1.960};
  TermOptions line_reprojection{true, 2.448};
  TermOptions line_depth{true, 2.448};
  // Parallel and alignment residuals have two degrees of freedom, perpendicular ones one.
  TermOptions parallel{true, 2.448};
  TermOptions perpendicular{true, 1.960};
  TermOptions manhattan{true, 2.448};
  bool line_endpoint_prior = true;
  // Prior along each line that keeps its end points from sliding: point-to-line residuals do not
  // see that motion, and where they disagree, they shrink the line towards the place where its
  // images cross. On that way a short line may turn to anywhere, and its pairs make the whole step
  // pay for it. Of 975 steps in 195 windows of ten sequences 16 % were refused with 5 cm, 1.7 %
  // with 2 cm, one with 1 cm, none with less.
  double line_endpoint_prior_sigma = 0.01;  // metres

  // An observation whose chi-square exceeds these after the first solve is rejected and the window
  // solved again without it: 99 % quantiles with 2 and, where there is a depth, 3 (4 for lines)
  // rows. Pairs and alignments likewise, 1 for the perpendicular ones and 2 for the others.
  double reject_chi2_1 = 6.635;
  double reject_chi2_2 = 9.210;
  double reject_chi2_3 = 11.345;
  double reject_chi2_4 = 13.277;

  // Noise and offsets are learnt after the first solve, for the second, and again after that.
  LandmarkNoiseOptions landmark_noise;

  int first_iterations = 5;    // with all observations
  int second_iterations = 10;  // after rejection

  bool IsValid(std::string* error) const;
};

struct TermSummary {
  int num_residual_blocks = 0;  // in the second solve
  // Reprojection: observations that contradict. Depth: those that lost their depth alone.
  // Structure: pairs or alignments that contradict.
  int num_rejected = 0;
  double initial_cost = 0.0;  // 0.5 * sum of robustified squares, before the first solve
  // After the second, of the blocks that are left, in the noise of landmarks that it was solved
  // with: where that was learnt in between, costs do not compare.
  double final_cost = 0.0;
};

struct BundleAdjustmentSummary {
  bool usable = false;     // false: the solver failed and the data were left unchanged
  int num_iterations = 0;  // in both solves
  double initial_cost = 0.0;
  double final_cost = 0.0;
  TermSummary point_reprojection, point_depth, line_reprojection, line_depth, line_endpoint_prior;
  TermSummary parallel, perpendicular, manhattan, pose_prior;
  int num_behind_camera = 0;  // observations dropped by the builder, marked rejected
  std::string
      schur_structure;  // how the normal equations were solved; of Ceres, schur_structure_used
  std::string message;

  std::string BriefReport() const;
};

// What LocalBundleAdjustment does at a time.
enum class WindowStage {
  kBuild,      // checks the data, makes the factors, tests the observations
  kLinearize,  // evaluates factors and derivatives
  kStep,       // solves the normal equations; of the Ceres solvers, the whole minimisation
  kWriteBack,
  kDone,
};

// Is told of every stage that begins. The solver has no clock, as nothing that it does may depend
// on one; whoever wants to know where the time goes brings his own.
using WindowStageObserver = std::function<void(WindowStage)>;

// Refines keyframes, points and lines that are not fixed (paper: Local Map Optimization).
// Where options.landmark_noise is on, learns the noise of all points and lines, fixed or not. Marks
// rejected observations, pairs and alignments in `data`, whatever the marks said before. A landmark
// that loses its last observation keeps its value; a pair or an alignment binds only lines that are
// observed, and is neither counted nor rejected otherwise, or where no line is free. At least one
// keyframe must be fixed or have a prior: that holds the gauge. Without any depth, only two that
// are hold the scale. A window in which nothing is observed comes back as it was. Throws
// std::invalid_argument, naming the offender, on a window without keyframes, an unknown or repeated
// id, a number that is not finite or beyond 1e9, a sigma <= 0, a covariance that is not symmetric
// or not positive definite, a segment without length, a pair of a line with itself, a count below
// 1, an axis that is not unit, no gauge, or options that are not valid.
BundleAdjustmentSummary LocalBundleAdjustment(const BundleAdjustmentOptions& options,
                                              WindowData* data,
                                              const WindowStageObserver& enter_stage = {});

}  // namespace msc_vo
