// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/self_calibration/window_residuals.h"

namespace msc_vo {

struct NoiseEstimatorOptions {
  bool enabled = true;
  // The sigmas that features come with count as much as what this many quarters of images show. A
  // window of ten keyframes and ten fixed ones has up to 80.
  double prior = 40.0;
  // Older windows are forgotten: the estimate rests on the last quarters, this many. Its own error
  // is sqrt(2 / 400) = 7 % of the variance. 150 to 400 are alike over all sequences.
  double memory = 400.0;
  // Bound of each scale, and of its inverse. Where measurements of one kind count little, the map
  // drifts away from them, and residuals say less and less about the sensor. 2, 3 and 5 are alike
  // over all sequences.
  double max_scale = 3.0;

  bool IsValid(std::string* error) const;
};

// How large the errors of measurements are: learnt from solved windows, as no data sheet knows the
// calibration of one's sensor or how sharp the lines of its images are.
//
// Lines in the image: their end points come from the fit to a whole edge, to 0.1 px where images
// are sharp, and to 0.7 px where they are blurred. The estimate is the spread of the middle half of
// the residuals; what lies far outside is left to the loss. (Points gain nothing from a scale of
// their own: theirs is alike everywhere.)
//
// Depths: it is not the spread of single residuals that counts. Errors of calibration and of
// rounding are common to whole parts of an image, so that many observations know no more than a
// few. The sum of n whitened residuals of independent errors has the variance n; the scale is the
// one with which that holds for the sums over the quarters of the images.
class NoiseEstimator {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit NoiseEstimator(const NoiseEstimatorOptions& options);

  NoiseScale scale() const;

  // Multiplies the sigmas of the window's observations.
  void Apply(WindowData* window) const;
  // Learns from the same window when it is solved.
  void Update(const WindowResiduals& residuals);

 private:
  // Square of one scale.
  struct Variance {
    double value = 1.0;
    double weight = 0.0;  // quarters of images that it rests on
  };
  double Scale(const Variance& variance) const;

  NoiseEstimatorOptions options_;
  Variance point_depth_, line_pixel_, line_depth_;
};

}  // namespace msc_vo
