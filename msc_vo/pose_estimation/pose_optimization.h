// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// One frame against a map that is held fixed (paper Eq. poseest).
struct PoseData {
  struct Point {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     // pixels, undistorted
    double sigma = 1.0;                                  // pixels
    double inverse_depth = 0.0;                          // 1/metres; 0: no depth measured
    double inverse_depth_sigma = 0.0;                    // 1/metres
    bool confirmed = true;                               // stood still from one keyframe to another
    bool dynamic = false;                                // out: by itself, see cell_consensus.h
    bool inlier = true;                                  // out
  };
  struct Line {
    LineSegment3 map_segment;  // metres, world
    LineSegment2 segment;      // pixels, undistorted
    double sigma = 1.0;        // pixels
    bool has_depth = false;
    LineDepth depth;        // used if has_depth
    bool confirmed = true;  // as of points
    bool dynamic = false;   // out
    bool inlier = true;     // out
  };

  PinholeCamera camera;
  Rigid3 cam_from_world;  // in: prediction, out: estimate
  std::vector<Point> points;
  std::vector<Line> lines;
};

// Of cell_consensus.h: whether most of the image agrees on the pose.
struct CellConsensusOptions {
  bool enabled = true;
  // Of parts, 53 pixels wide and high at 640x480. Nine sequences with something that moves, in a
  // first form with limits of 30, 20 and 15: 8 x 6 13 mm, 12 x 9 11, 16 x 12 23.
  int columns = 12;
  int rows = 9;
  // Beyond this many squared sigmas a part disagrees: the 99.9 % quantile of six rows, as a step of
  // its own takes away as many.
  double reject_chi2_6 = 22.458;
  // Of a vote of matches that are not proven, next to that of others. Without it (1) something that
  // moves, seen anew in each frame, holds half of the parts of a bare room. Fifteen sequences: 1.83
  // mm with 0.5, 1.64 with 0.3 and 1.55 with 0.1.
  double unconfirmed_weight = 0.1;
  // Parts by which another pose must be better. With two, four of six corridors in which nothing
  // moves changed, with three one, with four none.
  double min_cells = 3.0;

  bool IsValid(std::string* error) const;
};

struct PoseOptions {
  TermOptions point_reprojection{true, 2.448};
  TermOptions point_depth{true, 1.960};
  TermOptions line_reprojection{true, 2.448};
  TermOptions line_depth{true, 2.448};
  double reject_chi2_2 = 9.210;  // as in BundleAdjustmentOptions
  double reject_chi2_3 = 11.345;
  double reject_chi2_4 = 13.277;
  // The limits are for errors up to so many times the sigmas, as far as the median of the frame's
  // points asks for it. With 1, 1.5 and 2: fr1_rpy, which blurs, 14.0, 12.4 and 12.6 mm in the mean
  // of six runs, with LSD 20.7, 14.0 and 33.0; ten rendered sequences 0.73, 0.71 and 0.72, six with
  // other noise 1.06, 1.14 and 1.13 (geometric means; what differs there is chance).
  double max_frame_noise = 1.5;
  // Rounds of solving and re-classifying all matches, outliers of earlier rounds included; the last
  // rounds run without the loss, as what it guarded against is out by then.
  int num_rounds = 4;
  int num_robust_rounds = 2;
  int iterations_per_round = 6;
  CellConsensusOptions consensus;

  bool IsValid(std::string* error) const;
};

struct PoseSummary {
  bool usable = false;  // false: too few matches or the solver failed; the pose is the prediction
  int num_inlier_points = 0;
  int num_inlier_lines = 0;
  int num_dynamic = 0;  // points and lines that move by themselves: no inliers, and no failures
  std::vector<bool> dynamic_cells;  // of ImageGrid; empty if nothing moves
  double final_cost = 0.0;
  // Inverse of J^T J over the inliers: covariance of the estimate in the tangent of Rigid3Manifold
  // (rotation vector in the camera frame, radians; then translation, metres). Zero if not usable.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// Estimates the pose of one frame. Matches behind the camera become outliers. Usable needs six or
// more residual rows that fix all six degrees of freedom (the covariance exists).
// An observation whose depth alone contradicts stays an inlier and loses its depth.
// Throws std::invalid_argument, naming the match, on numbers that are not finite, sigmas <= 0,
// segments without length or bad options.
PoseSummary OptimizePose(const PoseOptions& options, PoseData* data);

}  // namespace msc_vo
