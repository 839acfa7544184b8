// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <vector>

#include "msc_vo/structure/coarse_axes.h"
#include "msc_vo/structure/direction_modes.h"

namespace msc_vo {

/// The directions of a view that coarse axes are estimated from: lines first, then surface normals.
struct DirectionEvidence {
  std::vector<WeightedDirection> all;  ///< weights sum to 1
  size_t num_lines = 0;

  size_t NumNormals() const { return all.size() - num_lines; }
  bool IsLine(size_t i) const { return i < num_lines; }
};

/// Number of lines and of normals from which a kind has its full weight: the fraction of 20
/// directions in a cone has a standard deviation of about 0.1.
constexpr double kFullWeightLines = 20.0;
constexpr double kFullWeightNormals = 200.0;

/// Selects the directions that are certain enough and weights both kinds by their number. The
/// result does not depend on the order of the input.
DirectionEvidence GatherEvidence(const CoarseAxesOptions& options,
                                 const std::vector<AxisEvidence>& lines,
                                 const std::vector<AxisEvidence>& normals);

}  // namespace msc_vo
