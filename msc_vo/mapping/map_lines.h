// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/submap.h"
#include "msc_vo/structure/structural_pairs.h"

namespace msc_vo {

struct RefinedLine {
  LineSegment3 segment;     ///< metres, world
  std::optional<int> axis;  ///< 0..2, of the Manhattan axis that it was aligned with
};

/// Refines the lines of a submap at the end of a run: bundle adjustment of the lines alone, with
/// all keyframes held fixed, in which uncertain lines follow the Manhattan axes as well
/// (SceneAxes::AddAllAlignments). Returns none if the submap has no refined axes.
std::map<LandmarkId, RefinedLine> RefineMapLines(const MapperOptions& options, const SubMap& submap,
                                                 const StructuralPairs& pairs);

}  // namespace msc_vo
