// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// Whether the landmarks that a frame matches are coplanar, but those of the map are not: the frame
/// may show a picture or a sign, which exist more than once. The matched landmarks are coplanar if
/// fewer than `min_matches`, and less than a quarter of them, are farther from their dominant plane
/// than 3 % of their distance from the camera; the map is not coplanar if at least `min_matches` of
/// its landmarks are farther. Also true if the matched landmarks are collinear, whatever the map.
bool IsCoplanar(const Revisit& found, const Map& map, int min_matches);

/// Whether surfaces contradict that a frame shows the place in `map` at which it was `found`,
/// although landmarks match: pictures and furniture made in series stand in rooms that differ. The
/// frame and the keyframes around its reference in `own`, the map that it is tracked in, are each
/// compared with the keyframe around the place that has the most similar view (CompareSurfaces).
/// The place is contradicted if they look through more than 1 % of the cells of these keyframes
/// that can be compared, and through at least ten. Surfaces that the map lacks do not count: a
/// person may stand there.
bool ContradictsSurfaces(const TrackedFrame& tracked, const Map& own, const Revisit& found,
                         const Map& map);

}  // namespace msc_vo
