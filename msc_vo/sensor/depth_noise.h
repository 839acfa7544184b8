// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Standard deviation of measured depth as a function of depth.
struct DepthSigma {
  double disparity = 0.0;     ///< part that is constant in 1/z, 1/metres
  double proportional = 0.0;  ///< part that is proportional to z, metres per metre
  double range = 0.0;         ///< part that is constant in z, metres

  /// Standard deviation of inverse depth at inverse depth `w`, 1/metres, to first order:
  /// |dw/dz| = w^2.
  double At(double w) const { return disparity + w * (proportional + w * range); }
};

/// Random noise of the pixels of a depth image.
struct DepthNoise : DepthSigma {
  /// A sensor that measures disparity with noise of standard deviation `sigma`, 1/metres. Implicit,
  /// because a number is the whole model of such a sensor.
  DepthNoise(double sigma) : DepthSigma{sigma} {}  // NOLINT(google-explicit-constructor)

  /// Distance over which the noise of neighbouring pixels is fully correlated, pixels: structured
  /// light matches windows of 7 to 9 px, dominated by their middle half.
  double correlation_length = 5.0;
  /// Width of the band beside a depth edge that has no usable depth, pixels: surfaces are continued
  /// across it.
  int edge_gap = 0;
};

}  // namespace msc_vo
