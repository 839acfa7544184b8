// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/map.h"

namespace msc_vo {

/// Gives all keyframes other intrinsics (see ChangeIntrinsics()), and moves every landmark to the
/// position that the first of its observations with a depth measures. Poses remain; the map should
/// be optimised.
void ChangeKeyframeIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics, Map* map);

}  // namespace msc_vo
