// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// The sliding window as plain data: what the window problem reads and writes. No pointers into any
// map; ids are the caller's and need only be unique within their vector. Observations, pairs and
// alignments may repeat, of the same landmarks in the same keyframe: each is a measurement of its
// own, with an error of its own.
struct WindowData {
  struct Keyframe {
    int64_t id = 0;
    Rigid3 cam_from_world;
    bool fixed = false;  // an observer outside the window, or the gauge
  };
  struct Point {
    int64_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
    bool fixed = false;
    // By which the sigmas of its observations are multiplied; positive. The solver learns it.
    double noise = 1.0;
  };
  struct Line {
    int64_t id = 0;
    LineSegment3 segment;  // metres, world
    bool fixed = false;
    double noise = 1.0;  // as of points
    // Metres, by which its depths are measured too far in all views alike; much less than they are.
    // The solver learns it.
    double depth_offset = 0.0;
  };
  struct PointObservation {
    int64_t keyframe = 0;
    int64_t point = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  // pixels, undistorted
    double sigma = 1.0;                               // pixels
    double inverse_depth = 0.0;                       // 1/metres; 0: no depth measured
    double inverse_depth_sigma = 0.0;                 // 1/metres
    bool rejected = false;  // set by the solver: contradicts the solution, or behind the camera
  };
  struct LineObservation {
    int64_t keyframe = 0;
    int64_t line = 0;
    LineSegment2 segment;  // pixels, undistorted
    double sigma = 1.0;    // pixels, of an end point's distance to the true line
    bool has_depth = false;
    LineDepth depth;        // used if has_depth
    bool rejected = false;  // as for points
  };

  // Two lines that should be parallel or perpendicular (paper: L_par^z, L_perp^z), seen together in
  // `count` keyframes: the paper's sum has the same term once for each.
  struct LinePair {
    int64_t a = 0;
    int64_t b = 0;
    double sigma = 0.03;    // radians, of the angle between them
    int count = 1;          // at least 1
    bool rejected = false;  // set by the solver: contradicts the solution
  };
  // A line that should be parallel to a Manhattan axis (paper: M).
  struct AxisAlignment {
    int64_t line = 0;
    Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // unit vector, world; its sign has no meaning
    double sigma = 0.03;                              // radians, of the angle between them
    bool rejected = false;                            // as for pairs
  };

  // Where a keyframe is believed to be, from elsewhere: a marginalised past, a marker, wheels. On a
  // fixed keyframe it says nothing.
  struct PosePrior {
    int64_t keyframe = 0;
    Rigid3 cam_from_world;
    // Of the six numbers of Rigid3Manifold: rotation vector in the camera frame (radians), then
    // translation (metres). Symmetric, positive definite.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
  };

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
};

}  // namespace msc_vo
