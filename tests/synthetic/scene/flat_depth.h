// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

// The camera of depth images to which noise is added.
inline const PinholeCamera kDepthCamera = KinectCamera(320, 240);

// Depth of a wall parallel to the image plane of kDepthCamera.
inline std::vector<float> FlatDepth(float depth) {
  return std::vector<float>(static_cast<size_t>(kDepthCamera.width) * kDepthCamera.height, depth);
}

}  // namespace msc_vo
