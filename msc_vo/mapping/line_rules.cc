// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/line_rules.h"

#include <algorithm>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// Two lines are duplicates if the angle between them (radians) and the distance of each midpoint
// from the other line, relative to the distance from the camera, are below these.
constexpr double kMaxAngle = DegreesToRadians(5.0);
constexpr double kMaxOffset = 0.02;

}  // namespace

std::vector<LineMatch> MatchForFusion(const FusionOptions& options, const Frame& frame,
                                      const std::vector<LineCandidate>& candidates) {
  return MatchLines(options.line_matcher, frame, candidates, kFusionRadius, {});
}

void SetLevel(const Keyframe& /*target*/, const LineLandmark& /*line*/,
              LineCandidate* /*candidate*/) {}

bool AgreesWithDepth(const Keyframe& /*keyframe*/, int /*feature*/, const LineLandmark& /*line*/) {
  return true;  // the depth of a line has an offset of its own
}

bool AreDuplicates(const Keyframe& keyframe, const LineLandmark& line_a,
                   const LineLandmark& line_b) {
  const LineSegment3 &a = line_a.segment, &b = line_b.segment;
  if (UndirectedAngle(a.Direction(), b.Direction()) > kMaxAngle) {
    return false;
  }
  const double distance = (a.Midpoint() - keyframe.cam_from_world.OriginInSource()).norm();
  return std::max(a.DistanceToLine(b.Midpoint()), b.DistanceToLine(a.Midpoint())) <
         kMaxOffset * distance;
}

}  // namespace msc_vo
