// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

namespace msc_vo {

// A direction whose sign means nothing, with the weight that it counts with.
struct WeightedDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit
  double weight = 1.0;
};

// Where directions crowd: modes of their density (Gaussian kernel of standard deviation
// `bandwidth`, radians), densest first, at most `max_modes`, each `separation` (radians) from the
// others at least. Quadratic in the number of directions: 3 ms for 1000.
std::vector<Eigen::Vector3d> FindDirectionModes(const std::vector<WeightedDirection>& directions,
                                                double bandwidth, double separation, int max_modes);

}  // namespace msc_vo
