// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"

namespace msc_vo {

/// The ratio by which the depth of a landmark by parallax exceeds the measured one: 0 if they are
/// equal, 0.05 if it is 5 % farther away.
struct DepthExcess {
  double value = 0.0;
  double variance = 0.0;
};

/// Triangulates the distance of a landmark from the centre of all cameras that observe it, at their
/// poses in the map, without depth, and compares it with the weighted mean of the measured depths,
/// LineLandmark::depth_offset not subtracted. `scale`: factors on the sigmas of the features.
/// std::nullopt with one keyframe, without a measured depth, or if the landmark is not in front of
/// all cameras.
template <typename L>
std::optional<DepthExcess> MeasureDepthExcess(const Map& map, const L& landmark,
                                              const NoiseScale& scale);

}  // namespace msc_vo
