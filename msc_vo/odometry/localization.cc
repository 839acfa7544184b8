// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/localization.h"

#include <algorithm>
#include <utility>

namespace msc_vo {

namespace {

// Index of the first frame of a segment whose pose is in the world of an earlier session.
std::optional<int> FirstFrame(const std::vector<Segment>& segments, const Segment& segment) {
  if (segment.is_earlier_session || !segments[segment.world].is_earlier_session) {
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
    const std::optional<int> frame = FirstFrame(result.segments, segment);
    if (frame) first = std::min(first.value_or(*frame), *frame);
  }
  return first;
}

void KeepLocalizedPoses(std::vector<Segment>* segments, std::vector<FrameResult>* frames) {
  FrameResult before;
  before.segment = before.world = kNoSegment;
  std::vector<Segment> kept = *segments;
  for (Segment& segment : kept) {
    segment.last_frame = segment.first_frame - 1;
    segment.num_estimated = 0;
  }
  for (int i = 0; i < static_cast<int>(frames->size()); ++i) {
    FrameResult& frame = (*frames)[i];
    std::optional<int> begin;
    if (frame.segment != kNoSegment) begin = FirstFrame(*segments, (*segments)[frame.segment]);
    if (!begin || i < *begin) Discard(before, &frame);
    before = frame;
    if (frame.segment == kNoSegment) continue;
    Segment& segment = kept[frame.segment];
    if (segment.last_frame < segment.first_frame) segment.first_frame = i;
    segment.last_frame = i;
    segment.num_estimated += IsEstimated(frame.status) ? 1 : 0;
  }
  *segments = std::move(kept);
}

FrameResult KeepLocalizedPose(int num_earlier_worlds, FrameResult frame) {
  if (frame.world != kNoSegment && frame.world < num_earlier_worlds) {
    const std::optional<WorldChange>& change = frame.world_changed;
    if (change && change->old_world >= num_earlier_worlds) frame.world_changed.reset();
    return frame;
  }
  FrameResult before;
  before.segment = before.world = kNoSegment;
  Discard(before, &frame);
  return frame;
}

}  // namespace msc_vo
