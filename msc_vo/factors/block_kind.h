// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>

namespace msc_vo {

/// Kinds of parameter blocks. The kind says what the numbers mean; the size does not: three numbers
/// may be a point, a direction or a plane.
enum class BlockKind {
  kPose,   ///< cam_from_world of a keyframe, 7: unit quaternion (x, y, z, w), translation
  kPoint,  ///< position, 3
  kLine,   ///< end points S and E, 6
  kAxes,   ///< world_from_axes of the Manhattan axes, 4: unit quaternion (x, y, z, w)
  kExtra,  ///< a block of the caller's own, of any size
};

/// Number of parameters of a block; 0 for kExtra, which has no size of its own.
constexpr int BlockSize(BlockKind kind) {
  constexpr int kSizes[] = {7, 3, 6, 4, 0};
  static_assert(sizeof(kSizes) / sizeof(int) == static_cast<size_t>(BlockKind::kExtra) + 1);
  return kSizes[static_cast<size_t>(kind)];
}

}  // namespace msc_vo
