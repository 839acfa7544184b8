// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Merges segments (pixels) that are pieces of the same line until no two can be merged: their
/// directions differ by at most 5 degrees, their end points are within 2 px of the common line and
/// the gap between them is at most 15 px. Segments are directed: two antiparallel segments are not
/// merged. The result is ordered by length, longest first, and does not depend on the order of
/// `segments`.
std::vector<LineSegment2> MergeCollinear(std::vector<LineSegment2> segments);

}  // namespace msc_vo
