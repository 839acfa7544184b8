// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/map_contents.h"
#include "msc_vo/mapping/map_joiner.h"
#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

/// Result of merging two maps.
struct MapMerge {
  MapContents contents;
  std::vector<MapJoin> joins;  ///< of submaps, in their order
  int num_loops = 0;           ///< closed after the joins
  /// Added to the ids of the keyframes of the second map.
  KeyframeId keyframe_offset = 0;
};

/// Merges the maps of two files (Odometry::ShareMaps(), LoadMap()). The keyframes of `second` are
/// searched in `first` as those of a run would be: submaps are joined where keyframes agree, then
/// loops are closed, duplicates of landmarks become one, and redundant keyframes go. Submaps
/// without a common place keep worlds of their own.
///
/// Worlds, sessions, and ids of keyframes and landmarks of `first` are kept, those of `second`
/// follow them; submaps are numbered anew. The keyframes of `second` are expressed in the camera of
/// `first`. Throws std::invalid_argument on invalid options.
MapMerge MergeMaps(const OdometryOptions& options, MapContents first, MapContents second);

}  // namespace msc_vo
