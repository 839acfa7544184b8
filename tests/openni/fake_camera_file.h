// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

namespace msc_vo {

// Start of a file of the fake camera. The images follow, each pair as RGB and depth in millimetres
// of 16 bits.
struct FakeCameraHeader {
  int32_t width = 0;
  int32_t height = 0;
  int32_t count = 0;
  float horizontal_fov = 0.0f;  // radians
  float vertical_fov = 0.0f;
};

}  // namespace msc_vo
