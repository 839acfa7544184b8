// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/matching/line_matcher.h"
#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

struct PoseFactors;
struct PoseOptions;

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

// What differs between the kinds of matches in motion-only bundle adjustment: lines. See
// point_pose_match.h.

/// Of a line that passes the camera at `cam_from_world`, only the visible part is observed.
LinePoseMatch MakePoseMatch(const LineMatch& match, const Frame& frame,
                            const Rigid3& cam_from_world, const LineLandmark* landmark,
                            const NoiseScale& scale);

const char* MatchError(const LinePoseMatch& line);

bool HasReprojection(const PoseOptions& options, const LinePoseMatch& line);
bool HasDepth(const PoseOptions& options, const LinePoseMatch& line);

inline LineSegment3 InCamera(const Rigid3& pose, const LinePoseMatch& line) {
  return pose * line.map_segment;
}

double PixelChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam);
double DepthChiSquare(const PinholeCamera& camera, const LinePoseMatch& line,
                      const LineSegment3& in_cam);
double LimitWithDepth(const PoseOptions& options, const LinePoseMatch& line);

/// Sigmas are evaluated at `pose`.
void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const LinePoseMatch& line,
                const InlierMask& mask, const Rigid3& pose, PoseFactors* factors);
void SetLosses(LandmarkKind<LineLandmark> kind, const PoseOptions& options, PoseFactors* factors);

inline int CellOf(const ImageGrid& grid, const LinePoseMatch& line) {
  return grid.CellOf(line.segment);
}
inline void AppendCells(const ImageGrid& grid, const LinePoseMatch& line, std::vector<int>* cells) {
  const std::vector<int> crossed = grid.CellsOf(line.segment);
  cells->insert(cells->end(), crossed.begin(), crossed.end());
}

void WeightByMapVariance(LinePoseMatch* line);
void AddVariances(const PoseOptions& options, const LinePoseMatch& line, const InlierMask& mask,
                  double* sum);

}  // namespace msc_vo
