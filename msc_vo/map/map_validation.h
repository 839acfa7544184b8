// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Describes the first violation of what every map satisfies between two changes; empty if there is
/// none. Keyframes have finite poses with unit quaternions and one entry per feature. Landmarks
/// have finite positions, a unit viewing direction, positive sigmas, scales and lengths, and
/// observations in order of keyframes. Every entry of a keyframe names a landmark that has this
/// observation, and vice versa. In Debug builds the mapper asserts it after every step.
std::string FirstViolation(const Map& map);

}  // namespace msc_vo
