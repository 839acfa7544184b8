// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Ratio of the actual errors of measurements to the sigmas of the features (self-calibration).
struct NoiseScale {
  double point_depth = 1.0;
  double line_pixel = 1.0;
  double line_depth = 1.0;
};

}  // namespace msc_vo
