// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>

namespace msc_vo {

/// 256-bit binary descriptor (rotated BRIEF for points, LBD for lines).
using Descriptor = std::array<uint8_t, 32>;

/// Number of differing bits, 0..256.
int HammingDistance(const Descriptor& a, const Descriptor& b);

}  // namespace msc_vo
