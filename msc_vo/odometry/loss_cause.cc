// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/loss_cause.h"

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
  switch (cause) {
    case LossCause::kUniformImage:
      return "black or uniform";
    case LossCause::kFewFeatures:
      return "with too few points and lines";
    case LossCause::kNoDepth:
      return "without depth";
    case LossCause::kDepthOutOfRange:
      return "with too few depths in range (is depth_scale right?)";
    case LossCause::kNoMatch:
      return "not fitting the map (fast or jerky motion, blur, or a wrong camera?)";
    case LossCause::kImplausible:
      return "after a gap, whose place is uncertain";
  }
  return "unknown";
}

const char* ToString(LossCause cause) {
  switch (cause) {
    case LossCause::kUniformImage:
      return "uniform_image";
    case LossCause::kFewFeatures:
      return "few_features";
    case LossCause::kNoDepth:
      return "no_depth";
    case LossCause::kDepthOutOfRange:
      return "depth_out_of_range";
    case LossCause::kNoMatch:
      return "no_match";
    case LossCause::kImplausible:
      return "implausible";
  }
  return "unknown";
}

}  // namespace msc_vo
