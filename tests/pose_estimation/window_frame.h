// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "tests/support/test_window.h"

namespace msc_vo {

// The keyframe of a test window whose pose is estimated.
constexpr int kFrame = 4;

inline Rigid3 Truth(const TestWindow& window) {
  return window.truth.keyframes[kFrame].cam_from_world;
}

}  // namespace msc_vo
