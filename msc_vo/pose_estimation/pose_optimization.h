// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/pose_estimation/pose_factor.h"
#include "msc_vo/pose_estimation/pose_match.h"

namespace msc_vo {

/// Input and output of motion-only bundle adjustment: the matches of one frame with a map that is
/// held fixed (paper Eq. poseest), and factors of the caller's own.
struct PoseData {
  using Point = PointPoseMatch;
  using Line = LinePoseMatch;

  PinholeCamera camera;
  Rigid3 cam_from_world;  ///< in: prediction, out: estimate
  std::vector<Point> points;
  std::vector<Line> lines;
  /// Added to the cost in every round, with their losses. They are neither classified as inliers or
  /// outliers nor part of the search for dynamic objects.
  std::vector<PoseFactor> custom_factors;
};

/// Dynamic-object rejection by cell consensus (CellConsensus).
struct CellConsensusOptions {
  /// Without it, features in free space become landmarks, too (MarkDynamicFeatures).
  bool enabled = true;
};

struct PoseOptions {
  TermOptions point_reprojection{true, kHuberThreshold[2]};
  TermOptions point_depth{true, kHuberThreshold[1]};
  TermOptions line_reprojection{true, kHuberThreshold[2]};
  TermOptions line_depth{true, kHuberThreshold[2]};
  double reject_chi2_2 = kOutlierChiSquare[2];  ///< as in BundleAdjustmentOptions
  double reject_chi2_3 = kOutlierChiSquare[3];
  double reject_chi2_4 = kOutlierChiSquare[4];
  /// Upper bound of the factor by which the sigmas of a frame are inflated for the chi-square
  /// tests: of single matches as far as the median residual of the points requires it, because a
  /// blurred image measures all its points worse; of cells (CellConsensus) as far as their median
  /// misfit does. Chosen by measurement, see docs/lab/tracking.md and docs/lab/dynamic_objects.md.
  double max_frame_noise = 1.5;
  /// Rounds of optimisation and reclassification of all matches, outliers of earlier rounds
  /// included. The rounds after `num_robust_rounds` use no robust loss, because the outliers that
  /// it guards against have been rejected.
  int num_rounds = 4;
  int num_robust_rounds = 2;
  int iterations_per_round = 6;
  CellConsensusOptions consensus;

  bool IsValid(std::string* error) const;
};

struct PoseSummary {
  /// False if there were too few matches or the solver failed; the pose is then the prediction.
  bool usable = false;
  PerKind<int> num_inliers;
  int num_dynamic = 0;    ///< matches in cells of dynamic objects: neither inliers nor outliers
  int num_confirmed = 0;  ///< matches with confirmed static landmarks, without dynamic matches
  int num_confirmed_inliers = 0;
  std::vector<bool> dynamic_cells;  ///< one per cell of the ImageGrid; empty if there are none
  /// Half the sum of squares over the inliers, and the robust cost of the custom factors.
  double final_cost = 0.0;
  /// Covariance of the estimate in the tangent of Rigid3Manifold (rotation vector in the camera
  /// frame, radians; then translation, metres): see CovarianceOfEstimate(). Zero if not usable.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Motion-only bundle adjustment: estimates the pose of one frame from its matches with map points
/// and lines, whose positions are held fixed (paper Eq. poseest). Matches behind the camera become
/// outliers. An observation whose depth alone contradicts stays an inlier and loses its depth.
/// The result is usable if at least six residual rows, those of custom factors included, constrain
/// all six degrees of freedom, so that the covariance exists.
/// Throws std::invalid_argument, naming the match, on numbers that are not finite, sigmas <= 0,
/// segments without length or invalid options; naming the custom factor, if its cost function is
/// null, has other blocks than one of size 7 or no residuals, or cannot be evaluated at the initial
/// pose.
PoseSummary OptimizePose(const PoseOptions& options, PoseData* data);

}  // namespace msc_vo
