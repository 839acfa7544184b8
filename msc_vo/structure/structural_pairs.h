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
  // As for the pairs of a frame (FrameStructureOptions), and for the same reasons.
  double max_angle = 1.75;   // degrees from 0 or 90
  double pair_sigma = 0.7;   // degrees, standard deviation of the angle of what was built so
  double gate_sigmas = 3.0;  // of that angle, as far as both lines and pair_sigma say
  int max_partners = 4;      // of each kind that a line chooses; those known best

  bool IsValid(std::string* error) const;
};

// Fills the window's parallel and perpendicular pairs (paper: L_par^z, L_perp^z of the lines z):
// lines that some keyframe of the window sees together and whose angle is near to 0 or 90 degrees,
// as far as their directions are known. Each line chooses the partners whose common angle is known
// best, so that the pairs carry the information and not the order of arrival; how many keyframes
// see both is the pair's count. Lines that the window binds to Manhattan axes are left out: an axis
// says the same, and says it once.
void AddStructuralPairs(const StructuralPairOptions& options, const Map& map, WindowData* window);

}  // namespace msc_vo
