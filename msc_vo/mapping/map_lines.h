// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/map/map.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/structure/scene_axes.h"
#include "msc_vo/structure/structural_pairs.h"

namespace msc_vo {

struct RefinedLine {
  LineSegment3 segment;     ///< metres, world
  std::optional<int> axis;  ///< 0..2, of the Manhattan axis that it was aligned with
};

/// Refines the lines of a map at the end of a run: bundle adjustment of the lines alone, with all
/// keyframes held fixed, in which uncertain lines follow the Manhattan axes as well
/// (SceneAxes::AddAllAlignments). `pairs` is a copy because adding pairs learns. Returns none if
/// the map has no refined axes.
std::map<LandmarkId, RefinedLine> RefineMapLines(const MapperOptions& options, const Map& map,
                                                 const SceneAxes& axes, StructuralPairs pairs,
                                                 const NoiseEstimator& noise);

}  // namespace msc_vo
