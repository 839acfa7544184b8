// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/line_landmark.h"
#include "msc_vo/matching/viewpoint.h"

namespace msc_vo {

struct LineMatcherOptions {
  /// Largest difference of direction in the image, degrees. Segments are directed, with the
  /// brighter region always on the same side, which distinguishes the two edges of a thin bar.
  double max_angle = 8.0;
  /// Largest Hamming distance, bits, between LBD descriptors of two observations of one line.
  int max_distance = 80;
};

/// As PointMatch.
struct LineMatch {
  int feature = 0;
  LandmarkId id = kNoId;
  LineSegment3 segment{};  ///< metres, world
  bool inlier = true;
};

/// A map line that is expected to be visible in a frame.
struct LineCandidate {
  using Match = LineMatch;

  LandmarkId id = kNoId;
  LineSegment3 segment;  ///< metres, world
  Descriptor descriptor{};
  LineSegment2 image;  ///< projection of the visible part, pixels
};

/// The candidate of a landmark, or of a feature of another frame at `segment` (metres, world),
/// without its projection.
LineCandidate CandidateOf(const LineLandmark& line);
inline LineCandidate CandidateOf(const LineFeature& feature, LandmarkId id,
                                 const LineSegment3& segment) {
  return {id, segment, feature.descriptor, {}};
}

/// Does nothing: lines have no pyramid level.
inline void SetLevel(const Viewpoint& /*view*/, const LineLandmark& /*line*/,
                     LineCandidate* /*candidate*/) {}

/// Projects `segment` and clips it to the image. Returns false if no part is visible or the visible
/// part is too short to have a direction.
bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      LineCandidate* candidate);

/// Completes the candidate of a landmark. Returns whether it is expected to be visible: it projects
/// into the image, and is observed from a similar direction.
bool IsVisible(const Viewpoint& view, const LineLandmark& line, LineCandidate* candidate);

/// Matches candidates with the lines of `frame` whose distance at the middle of the overlap is
/// below `radius` pixels. A feature is matched with the candidate of lowest cost, the first one on
/// ties. Dynamic features and those with `taken[feature]` are excluded; `taken` may be empty.
std::vector<LineMatch> MatchLines(const LineMatcherOptions& options, const Frame& frame,
                                  const std::vector<LineCandidate>& candidates, double radius,
                                  const std::vector<bool>& taken);

}  // namespace msc_vo
