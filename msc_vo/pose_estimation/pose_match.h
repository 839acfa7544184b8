// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/matching/point_matcher.h"
#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

struct PoseFactors;
struct PoseOptions;

/// The match of a point of a frame with a map that is held fixed (PoseData::Point).
struct PointPoseMatch {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();     ///< pixels, undistorted
  double sigma = 1.0;                                  ///< pixels
  double inverse_depth = 0.0;                          ///< 1/metres; 0: no depth measured
  double inverse_depth_sigma = 0.0;                    ///< 1/metres
  /// Variance of the landmark in the map, relative to that of this observation; 0: exact. It does
  /// not weigh the match, but widens the covariance of the pose.
  double map_variance = 0.0;
  /// The landmark is confirmed static: at least two keyframes observed it at the same position.
  bool confirmed = true;
  bool dynamic = false;  ///< out: lies in a cell of a dynamic object, see CellConsensus
  bool inlier = true;    ///< out
};

/// The match of a line of a frame with a map that is held fixed (PoseData::Line).
struct LinePoseMatch {
  LineSegment3 map_segment;  ///< metres, world
  LineSegment2 segment;      ///< pixels, undistorted
  double sigma = 1.0;        ///< pixels, of an end point's distance to the true line
  bool has_depth = false;
  LineDepth depth;            ///< used if has_depth
  double map_variance = 0.0;  ///< as for points
  bool confirmed = true;      ///< as for points
  bool dynamic = false;       ///< out
  bool inlier = true;         ///< out
};

// What differs between the kinds of matches in motion-only bundle adjustment.

/// The match as input of OptimizePose(). The sigmas of the feature are multiplied by `scale` and by
/// the noise of the landmark (nullptr: the match is with a feature of the last frame). Of a line
/// that passes the camera at `cam_from_world`, only the visible part is observed.
PointPoseMatch MakePoseMatch(const PointMatch& match, const Frame& frame,
                             const Rigid3& cam_from_world, const PointLandmark* landmark,
                             const NoiseScale& scale);
LinePoseMatch MakePoseMatch(const LineMatch& match, const Frame& frame,
                            const Rigid3& cam_from_world, const LineLandmark* landmark,
                            const NoiseScale& scale);

/// Describes what is invalid about a match; nullptr if nothing is.
const char* MatchError(const PointPoseMatch& point);
const char* MatchError(const LinePoseMatch& line);

/// Whether the options enable the reprojection of a match, and whether it has a depth that they
/// enable.
bool HasReprojection(const PoseOptions& options, const PointPoseMatch& point);
bool HasReprojection(const PoseOptions& options, const LinePoseMatch& line);
bool HasDepth(const PoseOptions& options, const PointPoseMatch& point);
bool HasDepth(const PoseOptions& options, const LinePoseMatch& line);

/// The landmark in camera coordinates, metres.
inline Eigen::Vector3d InCamera(const Rigid3& pose, const PointPoseMatch& point) {
  return pose * point.position;
}
inline LineSegment3 InCamera(const Rigid3& pose, const LinePoseMatch& line) {
  return pose * line.map_segment;
}

/// Squared residuals in sigmas of the observation: in the image, and of the depth. `in_cam` must be
/// in front of the camera.
double PixelChiSquare(const PinholeCamera& camera, const PointPoseMatch& point,
                      const Eigen::Vector3d& in_cam);
double PixelChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam);
double DepthChiSquare(const PinholeCamera& camera, const PointPoseMatch& point,
                      const Eigen::Vector3d& in_cam);
double DepthChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam);
/// Chi-square limit of reprojection and depth together.
double LimitWithDepth(const PoseOptions& options, const PointPoseMatch& point);
double LimitWithDepth(const PoseOptions& options, const LinePoseMatch& line);

/// Adds the active factors of a match; sigmas of lines are evaluated at `pose`.
void AddFactors(const PoseOptions& options, const PinholeCamera& camera,
                const PointPoseMatch& point, const InlierMask& mask, const Rigid3& pose,
                PoseFactors* factors);
void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const LinePoseMatch& line,
                const InlierMask& mask, const Rigid3& pose, PoseFactors* factors);
/// Sets the Huber thresholds of the terms of the kind.
void SetLosses(LandmarkKind<PointLandmark> kind, const PoseOptions& options, PoseFactors* factors);
void SetLosses(LandmarkKind<LineLandmark> kind, const PoseOptions& options, PoseFactors* factors);

/// The cell that contains a match, and all cells that it covers.
inline int CellOf(const ImageGrid& grid, const PointPoseMatch& point) {
  return grid.CellOf(point.pixel);
}
inline int CellOf(const ImageGrid& grid, const LinePoseMatch& line) {
  return grid.CellOf(line.segment);
}
inline void AppendCells(const ImageGrid& grid, const PointPoseMatch& point,
                        std::vector<int>* cells) {
  cells->push_back(grid.CellOf(point.pixel));
}
inline void AppendCells(const ImageGrid& grid, const LinePoseMatch& line, std::vector<int>* cells) {
  const std::vector<int> crossed = grid.CellsOf(line.segment);
  cells->insert(cells->end(), crossed.begin(), crossed.end());
}

/// Divides the variances of the observation by 1 + v, where v is the variance of the landmark.
void WeightByMapVariance(PointPoseMatch* point);
void WeightByMapVariance(LinePoseMatch* line);
/// Adds the variances 1 + v of the active residuals.
void AddVariances(const PoseOptions& options, const PointPoseMatch& point, const InlierMask& mask,
                  double* sum);
void AddVariances(const PoseOptions& options, const LinePoseMatch& line, const InlierMask& mask,
                  double* sum);

}  // namespace msc_vo
