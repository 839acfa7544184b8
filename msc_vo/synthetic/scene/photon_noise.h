// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>

#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

/// Noise of an image sensor in dim light, which is compensated by gain.
struct PhotonNoiseOptions {
  double light = 1.0;              ///< fraction of the light of a well-lit scene, more than 0
  double photons_per_level = 4.0;  ///< detected photons per grey value in full light
  double read_sigma = 1.2;         ///< grey values, before the gain

  bool IsValid(std::string* error) const;
};

/// Replaces every grey value g of each colour by (n / photons_per_level + e) / light, where n is a
/// Poisson deviate of mean light * photons_per_level * g, and e a normal deviate of read_sigma. The
/// variance is therefore g / (photons_per_level * light) + (read_sigma / light)^2. Saturated values
/// (255) stay. Deterministic for a given seed and frame. Throws std::invalid_argument on invalid
/// options.
void AddPhotonNoise(const PhotonNoiseOptions& options, uint64_t seed, uint64_t frame,
                    RenderedImage* image);

}  // namespace msc_vo
