// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Whether a frame matches little else than one plane, and the map extends beyond it: the frame may
/// show a picture or a sign, which exist more than once. Landmarks are in the plane if they are
/// nearer to it than 3 % of their distance from the camera; less than `min_matches` others are
/// little.
bool ShowsOnePlane(const Revisit& found, const Map& map, int min_matches);

/// Whether surfaces contradict that a frame shows the place in `map` at which it was `found`,
/// although landmarks match: pictures and furniture made in series stand in rooms that differ. The
/// keyframes around the place are compared with the frame and the keyframes around its reference in
/// `own`, the map that it is tracked in, each of these with the most similar view. The place is
/// contradicted if the camera looks through more than 1 % of the surfaces that the map has there.
/// What the map lacks does not count: a person may stand there.
bool ContradictsSurfaces(const TrackedFrame& tracked, const Map& own, const Revisit& found,
                         const Map& map);

}  // namespace msc_vo
