// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

struct StructuralPairOptions {
  bool parallel = true;
  bool perpendicular = true;
  /// As in FrameStructureOptions.
  double max_angle = 1.75;   ///< degrees from 0 or 90
  double pair_sigma = 0.7;   ///< degrees, standard deviation of the true angle of a pair
  double gate_sigmas = 3.0;  ///< largest deviation in sigmas of the measured angle
  int max_partners = 4;      ///< pairs of each kind per line, most certain first

  bool IsValid(std::string* error) const;
};

/// Adds the parallel and perpendicular pairs to the window (paper: L_par^z, L_perp^z of the lines
/// z): lines that at least one keyframe of the window observes together and whose angle is near to
/// 0 or 90 degrees given the uncertainty of both directions. Each line selects the partners with
/// the most certain angle. The count of a pair is the number of keyframes that observe both. Pairs
/// of two lines that are aligned with Manhattan axes are omitted, because the alignment holds the
/// same constraint.
void AddStructuralPairs(const StructuralPairOptions& options, const Map& map, WindowData* window);

}  // namespace msc_vo
