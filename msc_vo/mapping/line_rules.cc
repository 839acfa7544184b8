// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/line_rules.h"

#include <algorithm>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

std::vector<LineMatch> MatchForFusion(const FusionOptions& options, const Frame& frame,
                                      const std::vector<LineCandidate>& candidates) {
  return MatchLines(options.line_matcher, frame, candidates, options.radius, {});
}

void SetLevel(const Keyframe& /*target*/, const LineLandmark& /*line*/,
              LineCandidate* /*candidate*/) {}

bool AgreesWithDepth(const Keyframe& /*keyframe*/, int /*feature*/, const LineLandmark& /*line*/) {
  return true;  // the depth of a line has an offset of its own
}

bool AreDuplicates(const FusionOptions& options, const Keyframe& keyframe,
                   const LineLandmark& line_a, const LineLandmark& line_b) {
  const LineSegment3 &a = line_a.segment, &b = line_b.segment;
  if (UndirectedAngle(a.Direction(), b.Direction()) > DegreesToRadians(options.max_line_angle)) {
    return false;
  }
  const double distance = (a.Midpoint() - keyframe.cam_from_world.OriginInSource()).norm();
  return std::max(a.DistanceToLine(b.Midpoint()), b.DistanceToLine(a.Midpoint())) <
         options.max_line_offset * distance;
}

}  // namespace msc_vo
