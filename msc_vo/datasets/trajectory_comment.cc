// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory_comment.h"

#include <cstdio>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr char kNotEstimated[] = "not estimated";
constexpr char kSegmentFormat[] = "segment %d, world %d";

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string FormatPoseComment(const TimedPose& pose, int segment, int world) {
  std::string comment;
  if (pose.segment != segment || pose.world != world) {
    comment = FormatText(kSegmentFormat, pose.segment, pose.world);
  }
  if (!pose.is_estimated) comment += (comment.empty() ? "" : ", ") + std::string(kNotEstimated);
  return comment;
}

void ReadPoseComment(const std::string& comment, TimedPose* pose) {
  pose->is_estimated = !EndsWith(comment, kNotEstimated);
  int segment = 0, world = 0;
  if (std::sscanf(comment.c_str(), kSegmentFormat, &segment, &world) != 2) return;
  pose->segment = segment;
  pose->world = world;
}

}  // namespace msc_vo
