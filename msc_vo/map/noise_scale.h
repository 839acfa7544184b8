// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

// How many times larger the errors of measurements are than the sigmas that features come with.
struct NoiseScale {
  double point_depth = 1.0;
  double line_pixel = 1.0;
  double line_depth = 1.0;
};

}  // namespace msc_vo
