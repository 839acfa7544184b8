// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Gives a keyframe other intrinsics.
using KeyframeUpdate =
    std::function<std::shared_ptr<const Frame>(KeyframeId, const std::shared_ptr<const Frame>&)>;

/// Updates all keyframes, and moves every landmark to the position that the first of its
/// observations with a depth measures. Poses remain; the map should be optimised. Landmarks that an
/// earlier session has observed remain as well: the calibration of that is not in question.
void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map);

/// Expresses all keyframes in another camera (ChangeCamera()). Landmarks remain.
void ChangeKeyframeCamera(const PinholeCamera& camera, Map* map);

}  // namespace msc_vo
