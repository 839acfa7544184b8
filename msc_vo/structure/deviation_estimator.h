// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

/// Measured angle between a line and its ideal direction, in the plane perpendicular to that.
struct DirectionDeviation {
  Eigen::Vector2d angle = Eigen::Vector2d::Zero();           ///< two components, radians
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< of the measurement, radians^2
};
/// One component of such an angle.
struct AngleDeviation {
  double angle = 0.0;     ///< radians
  double variance = 1.0;  ///< of the measurement, radians^2
};

/// Learns how far lines deviate from the direction in which they were meant to be built, as far as
/// the sensor can tell. Deviations have heavy tails: most lines of a room follow its axes within
/// the precision of its construction, some lean. They are modelled by Student's distribution with
/// two degrees of freedom; its scale is estimated from the angles of the windows.
class DeviationEstimator {
 public:
  DeviationEstimator();

  /// Updates the scale by the angles of one window.
  void Update(const std::vector<DirectionDeviation>& deviations);

  double scale() const { return scale_; }  ///< radians

  /// Square of a measured angle in units of its expected square, deviation and measurement
  /// together.
  double ChiSquare(const DirectionDeviation& deviation) const;
  double ChiSquare(const AngleDeviation& deviation) const;
  /// Probability density of a measured angle, 1/radians^2 and 1/radians.
  double Density(const DirectionDeviation& deviation) const;
  double Density(const AngleDeviation& deviation) const;
  /// Standard deviation (radians) of the Gaussian that pulls a line with this angle as strongly as
  /// the distribution does: the farther off, the weaker.
  double Sigma(const DirectionDeviation& deviation) const;
  double Sigma(const AngleDeviation& deviation) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [scales, log_likelihoods, weight, scale] = *this;  // all members
    archive(log_likelihoods, weight, scale);
  }

 private:
  static constexpr int kNumScales = 24;
  using Grid = std::array<double, kNumScales>;

  void AddLogLikelihoods(const std::vector<DirectionDeviation>& deviations);

  Grid scales_{};           // radians, a geometric sequence
  Grid log_likelihoods_{};  // of the angles so far
  double weight_ = 0.0;     // number of angles so far
  double scale_;
};

}  // namespace msc_vo
