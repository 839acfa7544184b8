// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

// Why a frame that was looked at has no estimated pose, from the image towards the map: the first
// that applies.
enum class LossCause {
  kUniformImage,     // black, white, or grey without contrast
  kFewFeatures,      // an image with contrast, but hardly points or lines
  kNoDepth,          // features, but next to no pixel with a depth
  kDepthOutOfRange,  // depth is measured, but not, or not in range, at the features
  kNoMatch,          // features with depth that do not agree with the map
};
constexpr int kNumLossCauses = 5;

// For predicted and lost frames.
LossCause FindLossCause(const FrameResult& frame);

// A noun phrase that follows a number of images, for people.
const char* Describe(LossCause cause);
// "uniform_image", for files.
const char* ToString(LossCause cause);

}  // namespace msc_vo
