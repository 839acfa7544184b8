// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/localization.h"

#include <algorithm>

namespace msc_vo {

namespace {

// Index of the first frame of a segment whose pose is in the world of an earlier session.
std::optional<int> FirstFrame(const OdometryResult& result, const Segment& segment) {
  if (segment.is_earlier_session || !result.segments[segment.world].is_earlier_session) {
    return std::nullopt;
  }
  // A segment that began in a world that had been joined before has no join of its own.
  return std::max(segment.first_frame, segment.join ? segment.join->frame : 0);
}

}  // namespace

int NumEarlierWorlds(const OdometryResult& result) {
  return static_cast<int>(
      std::count_if(result.segments.begin(), result.segments.end(),
                    [](const Segment& segment) { return segment.is_earlier_session; }));
}

std::optional<int> FirstLocalizedFrame(const OdometryResult& result) {
  std::optional<int> first;
  for (const Segment& segment : result.segments) {
    const std::optional<int> frame = FirstFrame(result, segment);
    if (frame) first = std::min(first.value_or(*frame), *frame);
  }
  return first;
}

void KeepLocalizedPoses(OdometryResult* result) {
  const std::optional<int> first = FirstLocalizedFrame(*result);
  FrameResult before;
  before.segment = before.world = kNoSegment;
  for (int i = 0; i < static_cast<int>(result->frames.size()); ++i) {
    FrameResult& frame = result->frames[i];
    std::optional<int> begin;
    if (frame.segment != kNoSegment) begin = FirstFrame(*result, result->segments[frame.segment]);
    if (!begin || i < *begin) Discard(before, &frame);
    before = frame;
  }
  if (!result->segments.empty() && !result->segments[result->map_world].is_earlier_session) {
    // The map that the run has built elsewhere.
    result->keyframes.clear();
    result->points.clear();
    result->lines.clear();
    result->axes = {};
    result->map_world = first ? result->frames[*first].world : 0;
  }
  for (Segment& segment : result->segments) segment.num_estimated = 0;
  for (const FrameResult& frame : result->frames) {
    if (frame.segment == kNoSegment) continue;
    result->segments[frame.segment].num_estimated += IsEstimated(frame.status) ? 1 : 0;
  }
}

FrameResult KeepLocalizedPose(int num_earlier_worlds, FrameResult frame) {
  if (frame.world != kNoSegment && frame.world < num_earlier_worlds) return frame;
  FrameResult before;
  before.segment = before.world = kNoSegment;
  Discard(before, &frame);
  return frame;
}

}  // namespace msc_vo
