// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// Where the ids of the observations lead: positions in the vectors of WindowData.
struct WindowIndex {
  struct Link {
    int keyframe = 0;
    int landmark = 0;
  };
  std::vector<Link> points;  // one per point observation
  std::vector<Link> lines;   // one per line observation
  struct Pair {
    int a = 0;
    int b = 0;
  };
  std::vector<Pair> parallel;       // lines of the parallel pairs
  std::vector<Pair> perpendicular;  // lines of the perpendicular pairs
  std::vector<int> alignments;      // lines of the axis alignments
  std::vector<int> priors;          // keyframes of the pose priors
};

// Checks everything that LocalBundleAdjustment asks of its input, and resolves the ids on the way.
// Throws std::invalid_argument naming the offender.
WindowIndex ValidateWindow(const BundleAdjustmentOptions& options, const WindowData& data);

}  // namespace msc_vo
