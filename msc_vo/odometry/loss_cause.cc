// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/loss_cause.h"

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

LossCause FirstCause(const FrameResult& frame, int min_features) {
  if (frame.image.contrast < kMinImageContrast) return LossCause::kUniformImage;
  if (frame.num_points + frame.num_lines < min_features) return LossCause::kFewFeatures;
  if (frame.image.measured_depth < kMinMeasuredDepth) return LossCause::kNoDepth;
  if (frame.num_with_depth < min_features) return LossCause::kDepthOutOfRange;
  return LossCause::kNoMatch;
}

}  // namespace

std::optional<LossCause> FindLossCause(const FrameResult& frame, int min_features,
                                       bool is_implausible) {
  if (frame.status == TrackingStatus::kTracked) return std::nullopt;
  const LossCause cause = FirstCause(frame, min_features);
  return is_implausible && cause == LossCause::kNoMatch ? LossCause::kImplausible : cause;
}

const char* Describe(LossCause cause) {
  return EnumName<LossCause::kImplausible>(
      cause, {"black or uniform", "with too few points and lines", "without depth",
              "with too few depths in range (is depth_scale right?)",
              "not fitting the map (fast or jerky motion, blur, or a wrong camera?)",
              "after a gap, whose place is uncertain"});
}

const char* ToString(LossCause cause) {
  return EnumName<LossCause::kImplausible>(
      cause, {"uniform_image", "few_features", "no_depth", "depth_out_of_range", "no_match",
              "implausible"});
}

}  // namespace msc_vo
