// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Manhattan axes as a parameter block of custom factors; alignments do not use them.
struct WindowAxes {
  Eigen::Quaterniond world_from_axes = Eigen::Quaterniond::Identity();
  bool fixed = true;
};

/// Input and output of local bundle adjustment as plain data, independent of any map. Ids are
/// chosen by the caller and must be unique within their vector. Observations, pairs and alignments
/// may repeat for the same items: each is an independent measurement.
struct WindowData {
  struct Keyframe {
    int64_t id = 0;
    Rigid3 cam_from_world;  ///< Metres.
    bool fixed = false;     ///< Constant: an observer outside the window, or the gauge.
  };
  struct Point {
    int64_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< World, metres.
    bool fixed = false;
    double noise = 1.0;  ///< Factor on the sigmas of its observations, positive; may be estimated.
  };
  struct Line {
    int64_t id = 0;
    LineSegment3 segment;  ///< World, metres.
    bool fixed = false;
    double noise = 1.0;  ///< As for points.
    /// Measured minus true depth in all of its observations, metres; small compared with the depth.
    /// May be estimated.
    double depth_offset = 0.0;
  };
  struct PointObservation {
    int64_t keyframe = 0;
    int64_t point = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< Undistorted, pixels.
    double sigma = 1.0;                               ///< Of each coordinate, pixels.
    double inverse_depth = 0.0;                       ///< 1/metres; 0: not measured.
    double inverse_depth_sigma = 0.0;                 ///< 1/metres.
    bool rejected = false;                            ///< Output: an outlier, or behind the camera.
    /// Output: the depth is an outlier, and the observation an inlier without it.
    bool depth_rejected = false;
  };
  struct LineObservation {
    int64_t keyframe = 0;
    int64_t line = 0;
    LineSegment2 segment;  ///< Undistorted, pixels.
    double sigma = 1.0;    ///< Of an end point's distance to the true image line, pixels.
    bool has_depth = false;
    LineDepth depth;              ///< Valid if has_depth.
    bool rejected = false;        ///< Output, as for points.
    bool depth_rejected = false;  ///< Output, as for points.
  };

  /// Parallel or perpendicular pair of lines (paper: L_par^z, L_perp^z).
  struct LinePair {
    int64_t a = 0;
    int64_t b = 0;
    double sigma = 0.03;  ///< Of the angle between the lines, radians.
    /// Multiplicity of the term, at least 1: in the paper's sum, the number of keyframes that
    /// observe both lines.
    int count = 1;
    bool rejected = false;  ///< Output: an outlier.
  };
  /// Line parallel to a Manhattan axis (paper: M).
  struct AxisAlignment {
    int64_t line = 0;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< Unit vector in the world, of either sign.
    double sigma = 0.03;                              ///< Of the angle between them, radians.
    bool rejected = false;                            ///< Output: an outlier.
  };

  /// Prior on a keyframe pose from another source, such as marginalisation, a marker or wheel
  /// odometry. Ignored on fixed keyframes.
  struct PosePrior {
    int64_t keyframe = 0;
    Rigid3 cam_from_world;  ///< Mean.
    /// In the tangent space of Rigid3Manifold: rotation vector in the camera frame (radians), then
    /// translation (metres). Symmetric, positive definite.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  };

  using Axes = WindowAxes;  ///< declared before: Clang's std::optional needs a complete type

  PinholeCamera camera;
  std::vector<Keyframe> keyframes;
  std::vector<Point> points;
  std::vector<Line> lines;
  std::vector<PointObservation> point_observations;
  std::vector<LineObservation> line_observations;
  std::vector<LinePair> parallel_pairs;
  std::vector<LinePair> perpendicular_pairs;
  std::vector<AxisAlignment> axis_alignments;
  std::vector<PosePrior> pose_priors;
  std::optional<Axes> axes;
  std::vector<ExtraBlock> extra_blocks;
  std::vector<CustomFactor> custom_factors;
};

}  // namespace msc_vo
