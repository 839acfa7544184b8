// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/factors/chi_square.h"

namespace msc_vo {

/// Robust loss of one cost term, and whether the term is used. Sigmas are part of the data.
struct TermOptions {
  bool enabled = true;
  double huber = 2.0;  ///< Huber threshold, in standard deviations of the residual.
};

/// Estimation of a noise factor per landmark and a depth offset per line from their residuals.
struct LandmarkNoiseOptions {
  /// Off by default: covariances are then those of the given sigmas. MapperOptions enables it.
  bool enabled = false;
};

/// Search for gross errors that a landmark with few views has followed (docs/method.md).
struct ConsensusOptions {
  /// On by default, for windows from anywhere. MapperOptions disables it: its next window tests the
  /// same observations again. A solve takes 5 to 25 times as long, mostly for the leave-one-out
  /// fits of landmarks: 30 instead of 2 ms for nine keyframes in a corridor.
  bool enabled = true;
};

/// Solver of the nonlinear least-squares problem. All of them minimise the same functors and go to
/// the same minimum. Where a step moves a landmark behind a camera that observes it or leaves a
/// line without length, kBlockSchur keeps that landmark and takes the rest of the step, and Ceres
/// rejects the step.
enum class BundleAdjustmentSolver {
  kBlockSchur,        ///< Specialised block-sparse Schur complement; the fastest.
  kCeres,             ///< Ceres (WindowProblem): sparse Schur complement, factorised by Eigen.
  kCeresSuiteSparse,  ///< The same, factorised by SuiteSparse, if Ceres was built with it.
};

struct BundleAdjustmentOptions {
  BundleAdjustmentSolver solver = BundleAdjustmentSolver::kBlockSchur;
  TermOptions point_reprojection{true, kHuberThreshold[2]};
  TermOptions point_depth{true, kHuberThreshold[1]};
  TermOptions line_reprojection{true, kHuberThreshold[2]};
  TermOptions line_depth{true, kHuberThreshold[2]};
  /// Parallel and alignment residuals have two degrees of freedom, perpendicular ones have one.
  TermOptions parallel{true, kHuberThreshold[2]};
  TermOptions perpendicular{true, kHuberThreshold[1]};
  TermOptions manhattan{true, kHuberThreshold[2]};
  /// Prior on the end points of a line along its direction (LineEndpointPrior). Line reprojection
  /// does not constrain that motion, and inconsistent observations would shrink the line until its
  /// direction is arbitrary and its structural terms cause the step to be rejected.
  bool line_endpoint_prior = true;
  /// Standard deviation in metres; larger values cause rejected steps, see
  /// docs/lab/bundle_adjustment.md.
  double line_endpoint_prior_sigma = 0.01;

  /// Outlier thresholds of the squared norm of residuals with 1 to 4 rows. After the first solve,
  /// observations are tested with 2 rows without depth, with 3 (points) or 4 (lines) rows with
  /// depth; perpendicular pairs with 1; parallel pairs and alignments with 2. The second solve
  /// excludes outliers.
  double reject_chi2_1 = kOutlierChiSquare[1];
  double reject_chi2_2 = kOutlierChiSquare[2];
  double reject_chi2_3 = kOutlierChiSquare[3];
  double reject_chi2_4 = kOutlierChiSquare[4];

  /// Noise factors and depth offsets are estimated after each of the two solves.
  LandmarkNoiseOptions landmark_noise;

  /// After each solve, every observation is tested against the other views of its landmark, and the
  /// second solve repeated while marks change.
  ConsensusOptions consensus;

  int first_iterations = 5;    ///< Maximum number of steps with all observations.
  int second_iterations = 10;  ///< Maximum number of steps without outliers.

  bool IsValid(std::string* error) const;
};

struct TermSummary {
  int num_residual_blocks = 0;  ///< In the second solve.
  /// Outliers. Reprojection terms: observations. Depth terms: observations that lost only their
  /// depth. Structural terms: pairs or alignments.
  int num_rejected = 0;
  double initial_cost = 0.0;  ///< Half the sum of robust squared norms before the first solve.
  /// The same after the second solve, over inliers, with the noise factors of that solve; not
  /// comparable with initial_cost where noise factors changed in between.
  double final_cost = 0.0;
};

struct BundleAdjustmentSummary {
  bool usable = false;     ///< False: the solver failed and the data are unchanged.
  int num_iterations = 0;  ///< Steps of both solves.
  int num_accepted = 0;    ///< Those that decreased the cost enough to be taken.
  double initial_cost = 0.0;
  double final_cost = 0.0;
  TermSummary point_reprojection, point_depth, line_reprojection, line_depth, line_endpoint_prior;
  TermSummary parallel, perpendicular, manhattan, pose_prior, custom;
  int num_behind_camera = 0;  ///< Observations of landmarks behind the camera, marked as rejected.
  /// With options.consensus, ids of items that the inliers do not determine: EstimateCovariance()
  /// gives no covariance for them. Their values are estimates in the other directions at most.
  std::vector<int64_t> undetermined_keyframes, undetermined_points, undetermined_lines;
  /// Structure of the normal equations; for Ceres solvers, its schur_structure_used.
  std::string schur_structure;
  std::string message;  ///< Reason for termination.

  /// All terms with their names, such as "point_reprojection", in the order of the report.
  std::vector<std::pair<std::string, const TermSummary*>> Terms() const;

  /// Human-readable report of several lines.
  std::string BriefReport() const;
};

/// Stage of LocalBundleAdjustment.
enum class WindowStage {
  kBuild,      ///< Validation, construction of the factors, outlier test.
  kLinearize,  ///< Evaluation of residuals and derivatives.
  kStep,       ///< Solution of the normal equations; for Ceres solvers the whole minimisation.
  kWriteBack,
  kDone,
};

/// Called at the start of every stage. To profile a solve, pass an observer that reads a clock; the
/// solver itself has none, so that its results cannot depend on time.
using WindowStageObserver = std::function<void(WindowStage)>;

/// Local bundle adjustment (paper: Local Map Optimization): refines the poses, points and lines of
/// `data` that are not fixed. Solves once with all observations, tests every observation, pair and
/// alignment with chi-square, and solves again with the inliers.
///
/// - Rejection marks in `data` are overwritten; marks from earlier calls are ignored.
/// - With options.landmark_noise, also estimates the noise of all points and lines, fixed or not.
/// - A landmark without inlier observations keeps its value, as does a keyframe without inlier
///   observations or prior.
/// - Pairs and alignments are used if each of their lines is observed or fixed, and at least one is
///   observed and free; others are neither counted nor rejected.
/// - With options.consensus, observations and depths beyond their limits at the result are marked,
///   and the summary lists what is not determined. A landmark that its views do not determine moves
///   only in the directions that they do, unless relations or custom factors couple it.
/// - The gauge must be fixed by at least one keyframe that is fixed or has a prior, or by custom
///   factors. Without depth, the scale requires two of them.
/// - Custom factors are not tested for outliers; a robust loss guards against these. A step is
///   rejected if it leads to where the cost function of a factor fails, or where its cost or a
///   derivative is not finite.
///
/// Throws std::invalid_argument that names the offending item for: a window without keyframes, an
/// unknown or repeated id, a number that is not finite or beyond 1e9, a sigma <= 0, a covariance
/// that is not symmetric positive definite, a segment of zero length, a pair of a line with itself,
/// a count below 1, an axis that is not a unit vector, an extra block on UnitVectorManifold or
/// PlaneManifold without a unit vector, a free gauge, or invalid options; and for a custom factor
/// without cost function, with parameter blocks of the wrong number or size, with a block twice, or
/// that cannot be evaluated at the initial values.
BundleAdjustmentSummary LocalBundleAdjustment(const BundleAdjustmentOptions& options,
                                              WindowData* data,
                                              const WindowStageObserver& enter_stage = {});

}  // namespace msc_vo
