// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cmath>

namespace msc_vo {

/// Ratio of the width of an image to 640 pixels, the width that lengths in pixels refer to where
/// they are angles or parts of the image.
inline double ImageScale(int width) { return width / 640.0; }

/// The length in an image of `width` pixels that is `length` pixels in one of 640, rounded, at
/// least `least`.
inline int ScaledLength(double length, int width, int least) {
  return std::max(least, static_cast<int>(std::lround(length * ImageScale(width))));
}

/// Step between the pixels of an image of `width` pixels that make up a reduced image, which is at
/// most 640 pixels wide.
inline int ReducingStep(int width) { return width <= 640 ? 1 : 1 + (width - 1) / 640; }

}  // namespace msc_vo
