// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/surface_view.h"

namespace msc_vo {

struct ReturnOptions {
  /// Least overlap with the earlier image, in both directions.
  double min_overlap = 0.3;
  double max_angle = DegreesToRadians(45.0);  ///< between the optical axes, radians
  /// The camera has left a place if an image in between shows at most this ratio of the later
  /// image's surfaces.
  double max_between = 0.05;
};

/// A time in which the camera is back at a place that it had left. Indices of views.
struct TrueReturn {
  int first = 0, last = 0;  ///< the consecutive views that show an earlier place
  int later = 0;            ///< of these, the one with the largest overlap
  int earlier = 0;          ///< view of the same place before
  double overlap = 0.0;     ///< of both, the smaller direction
};

/// Finds the returns among views in order of time.
std::vector<TrueReturn> FindReturns(const std::vector<SurfaceView>& views,
                                    const ReturnOptions& options = {});

}  // namespace msc_vo
