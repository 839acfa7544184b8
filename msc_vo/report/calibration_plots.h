// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/report/plot_page.h"

namespace msc_vo {

/// Residual of a point that two images have in common, as plain data.
struct CalibrationResidual {
  double radius = 0.0;        ///< pixels, distance of the point from the centre of the image
  double reprojection = 0.0;  ///< pixels, distance of the prediction from the observation
  double depth = 0.0;         ///< metres
  double depth_error = 0.0;   ///< relative to the depth, without sign
};

/// Residuals with the calibration that was given and with the one that was estimated; the latter
/// are empty if nothing is corrected.
struct CalibrationResiduals {
  std::vector<CalibrationResidual> given;
  std::vector<CalibrationResidual> estimated;
};

/// The distribution of the residuals of pixels and of depth, and their medians over the radius and
/// over the depth. There are no figures without residuals.
std::vector<PlotFigure> PlotResiduals(const CalibrationResiduals& residuals);

/// Median of a member of the residuals, which must not be empty.
double MedianResidual(const std::vector<CalibrationResidual>& residuals,
                      double CalibrationResidual::*member);

}  // namespace msc_vo
