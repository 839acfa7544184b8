// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"

namespace msc_vo {

/// Finds the landmarks of an optimised window that the image shows behind the surface whose depth
/// was measured (Landmark::has_false_depth): through a pane of glass, in a mirror, or beside an
/// edge with the depth of a nearer surface.
///
/// A depth is false if its excess (MeasureDepthExcess) is likelier to have any value up to a half
/// than to be one of those of the image. These have in common what a wrong length of the motion
/// causes. Parts of the image are tested as a whole, because the parallax of single landmarks is
/// often too small, and landmarks one by one.
///
/// `newest`: the keyframe whose image is divided; landmarks that it does not show remain as they
/// are. `scale`: of the sigmas of the features.
void FindFalseDepths(const WindowData& window, KeyframeId newest, const NoiseScale& scale,
                     Map* map);

}  // namespace msc_vo
