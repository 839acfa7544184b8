// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

namespace msc_vo {

/// An undirected direction with its weight.
struct WeightedDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit
  double weight = 1.0;
};

/// Returns the modes of the density of the directions under a Gaussian kernel of standard deviation
/// `bandwidth` (radians), densest first: at most `max_modes`, at least `separation` (radians)
/// apart. Quadratic in the number of directions.
std::vector<Eigen::Vector3d> FindDirectionModes(const std::vector<WeightedDirection>& directions,
                                                double bandwidth, double separation, int max_modes);

}  // namespace msc_vo
