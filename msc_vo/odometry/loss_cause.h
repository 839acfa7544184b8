// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

/// Probable cause why a processed frame has no estimated pose: the first one that applies, in the
/// order of processing.
enum class LossCause {
  kUniformImage,     ///< image without contrast: black, white or grey
  kFewFeatures,      ///< image with contrast, but too few points and lines
  kNoDepth,          ///< features, but almost no pixel with a depth
  kDepthOutOfRange,  ///< depth image, but too few features with a depth in the valid range
  kNoMatch,          ///< features with depth that are not consistent with the map
};
constexpr int kNumLossCauses = 5;

/// The cause for a predicted or lost frame.
LossCause FindLossCause(const FrameResult& frame);

/// An attribute of "images" for messages: "with too few points and lines".
const char* Describe(LossCause cause);
/// A name for files: "uniform_image".
const char* ToString(LossCause cause);

}  // namespace msc_vo
