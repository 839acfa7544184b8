// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/structure/deviation_estimator.h"

namespace msc_vo {

struct StructuralPairOptions {
  bool parallel = true;
  bool perpendicular = true;
  /// Range around 0 and 90 degrees in which pairs are sought, degrees: wide enough to show how many
  /// pairs lie there by chance.
  double max_angle = 3.0;
};

/// Pairs of lines of a window whose angle is near to 0 or 90 degrees.
struct PairCandidates {
  template <typename Deviation>
  struct Pair {
    double sigma = 0.0;  ///< radians, of the angle between the two
    int i = 0, j = 0;    ///< indices of both lines in `lines`
    Deviation deviation;
    double probability = 0.0;  ///< of a relation
  };
  using Parallel = Pair<DirectionDeviation>;
  using Perpendicular = Pair<AngleDeviation>;

  std::vector<int64_t> lines;  ///< ids of the lines whose directions are certain enough
  std::vector<Parallel> parallel;
  std::vector<Perpendicular> perpendicular;
};

/// Finds the most certain pairs of each line among those that a keyframe of the window observes
/// together, without pairs of two lines that are aligned with axes.
PairCandidates FindPairCandidates(const StructuralPairOptions& options, const WindowData& window);

}  // namespace msc_vo
