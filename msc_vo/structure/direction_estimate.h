// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

/// Direction of a line, as all of its observations determine it.
struct DirectionEstimate {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit, world; its sign has no meaning
  /// Radians squared; zero along the direction.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Standard deviation of its least certain component, radians.
  double Sigma() const;
};

/// Estimates the direction of each line of the window from its observations in all keyframes, at
/// the given poses. Every view constrains the direction to its interpretation plane; a view with a
/// depth also constrains the angle in that plane. std::nullopt where this leaves a component
/// undetermined.
///
/// Unlike the lines of the window, the estimates do not contain earlier structural constraints, so
/// that they tell how well a constraint holds.
std::vector<std::optional<DirectionEstimate>> EstimateDirections(const WindowData& window);

}  // namespace msc_vo
