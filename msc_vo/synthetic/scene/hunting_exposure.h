// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

/// Automatic exposure that hunts, and vignetting of the lens.
struct HuntingExposureOptions {
  double amplitude = 0.6;    ///< of the gain around 1
  double period = 1.9;       ///< seconds
  double vignetting = 0.55;  ///< fraction of the light that is lost in the corners

  bool IsValid(std::string* error) const;
};

/// Multiplies the grey values of an image taken `seconds` after the start by
/// (1 + amplitude sin(2 pi seconds / period)) (1 - vignetting r^2), with the distance r from the
/// centre in half diagonals. Bright pixels saturate. Throws std::invalid_argument on invalid
/// options.
void ApplyHuntingExposure(const HuntingExposureOptions& options, double seconds,
                          RenderedImage* image);

}  // namespace msc_vo
