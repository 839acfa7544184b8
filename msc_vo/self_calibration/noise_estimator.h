// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/noise_scale.h"
#include "msc_vo/self_calibration/window_residuals.h"

namespace msc_vo {

struct NoiseEstimatorOptions {
  bool enabled = true;
  /// Weight of the initial scale 1, in image quadrants. A window of ten free and ten fixed
  /// keyframes has up to 80 quadrants.
  double prior = 40.0;

  bool IsValid(std::string* error) const;
};

/// Self-calibration of the measurement noise: estimates the ratio of the actual errors to the
/// sigmas of the features from the residuals of optimised windows. It adapts to the calibration of
/// the sensor and to the sharpness of the images.
///
/// Lines in the image: the end points come from a fit to a whole edge, with errors of 0.1 px in
/// sharp images and 0.7 px in blurred ones. The scale is the robust standard deviation (by the
/// median) of the residuals; outliers are left to the robust loss. Pixels of points have no scale,
/// because their errors hardly vary between sequences.
///
/// Depths: errors of calibration and quantisation are common to whole regions of an image, so that
/// many observations contain little more information than one. The spread of single residuals does
/// not show this. The sum of n whitened residuals with independent errors has variance n; the scale
/// is the one for which this holds for the sums over the quadrants of the images.
class NoiseEstimator {
 public:
  /// Upper bound of each scale and of its inverse. If one kind of measurement had little weight,
  /// the map would drift away from it, and its residuals would no longer reflect the sensor.
  /// Chosen by measurement, see docs/lab/self_calibration.md.
  static constexpr double kMaxScale = 3.0;

  /// Throws std::invalid_argument on invalid options.
  explicit NoiseEstimator(const NoiseEstimatorOptions& options);

  NoiseScale scale() const;
  /// Begins with scales of an earlier run, with the weight of a prior.
  void Restore(const NoiseScale& scale);

  /// Multiplies the sigmas of the window's observations by the scales.
  void Apply(WindowData* window) const;
  /// Updates the scales from a window after Apply() and its optimisation.
  void Update(const WindowResiduals& residuals);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, point_depth, line_pixel, line_depth] =
        *this;  // all members, or it does not compile
    archive(point_depth, line_pixel, line_depth);
  }

 private:
  // Square of a scale.
  struct Variance {
    double value = 1.0;
    double weight = 0.0;  // image quadrants
  };
  double Scale(const Variance& variance) const;
  // Blends in the variance ratio of a window whose sigmas had been multiplied by Scale(*variance).
  void AddEstimate(double variance_ratio, int num_quadrants, Variance* variance) const;

  NoiseEstimatorOptions options_;
  Variance point_depth_, line_pixel_, line_depth_;
};

}  // namespace msc_vo
