// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// The pose graph of a submap in the format of g2o: a vertex world_from_cam for each keyframe
/// (metres), an edge for each loop with the inverse of its covariance, and an edge for each pair of
/// keyframes that share at least 20 landmarks. The information of the latter, which no measurement
/// gives, is that of a millimetre and a milliradian divided by the number of shared landmarks.
std::string FormatG2o(const SavedSubMap& submap, const std::vector<PoseGraphEdge>& loops);

/// Writes each submap to a folder `submap_<id>` in `folder`: points.ply, lines.ply, graph.g2o and,
/// for each session with keyframes in it, keyframes_<number>.txt, a TUM trajectory. Throws
/// std::runtime_error that names the file that cannot be written.
void ExportMap(const MapContents& contents, const std::string& folder);

}  // namespace msc_vo
