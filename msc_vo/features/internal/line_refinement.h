// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

/// Refines a detected segment (pixels) to sub-pixel accuracy by moving its end points across it: at
/// samples along the segment, the steepest increase of the grey values towards its bright side is
/// located to sub-pixels, and a line is fitted to these positions, weighted by contrast and without
/// outliers. The brighter side must be where ImageLine() is positive. Returns false, and leaves the
/// segment unchanged, if there is no such edge within 1.5 px.
bool RefineSegment(const cv::Mat& gray, LineSegment2* segment);

}  // namespace msc_vo
