// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/true_returns.h"

#include <algorithm>
#include <optional>

namespace msc_vo {

namespace {

// The earlier view of the place that view `later` has come back to, with the largest overlap.
std::optional<TrueReturn> ReturnOf(const std::vector<SurfaceView>& views, int later,
                                   const ReturnOptions& options) {
  std::optional<TrueReturn> best;
  bool has_left = false;
  for (int earlier = later - 1; earlier >= 0; --earlier) {
    const SurfaceView &b = views[later], &a = views[earlier];
    const double forth = OverlapOf(b, a);
    if (has_left && forth >= options.min_overlap && ViewingAngle(a, b) <= options.max_angle) {
      const double overlap = std::min(forth, OverlapOf(a, b));
      if (overlap >= options.min_overlap && (!best || overlap > best->overlap)) {
        best = TrueReturn{later, later, later, earlier, overlap};
      }
    }
    has_left = has_left || forth <= options.max_between;
  }
  return best;
}

}  // namespace

std::vector<TrueReturn> FindReturns(const std::vector<SurfaceView>& views,
                                    const ReturnOptions& options) {
  std::vector<TrueReturn> returns;
  for (int later = 0; later < static_cast<int>(views.size()); ++later) {
    std::optional<TrueReturn> found = ReturnOf(views, later, options);
    if (!found) continue;
    if (!returns.empty() && returns.back().last == later - 1) {
      TrueReturn& run = returns.back();
      found->first = run.first;
      if (found->overlap < run.overlap) {
        run.last = later;
      } else {
        run = *found;
      }
    } else {
      returns.push_back(*found);
    }
  }
  return returns;
}

}  // namespace msc_vo
