// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"

namespace msc_vo {

/// Flags the landmarks of an optimised window that the image shows behind the surface whose depth
/// was measured (Landmark::has_false_depth): through a pane of glass, or beside an edge with the
/// depth of a nearer surface. Clears the flag of the others.
///
/// The excess of a depth is the ratio by which the distance of a landmark by parallax exceeds the
/// measured one. A depth is false if its excess is likelier to have any value up to 0.5 than to
/// come from the distribution of true depths, whose mean contains the error of the scale of the
/// translation. Cells of the image are tested as a whole, because the parallax of single landmarks
/// is often too small, and landmarks one by one.
///
/// `newest`: the keyframe whose image is divided into cells. Landmarks that do not project into it
/// keep their flag, and so do all if fewer than six cells have three points with an excess.
/// `scale`: factors on the sigmas of the features.
void FindFalseDepths(const WindowData& window, KeyframeId newest, const NoiseScale& scale,
                     Map* map);

}  // namespace msc_vo
