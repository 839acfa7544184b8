// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/photon_noise.h"

#include <stdexcept>

#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo {

bool PhotonNoiseOptions::IsValid(std::string* error) const {
  if (!(light > 0.0 && light <= 1.0)) {
    *error = "photon noise: light must be more than 0 and at most 1";
  } else if (!(photons_per_level > 0.0)) {
    *error = "photon noise: photons_per_level must be positive";
  } else if (!(read_sigma >= 0.0)) {
    *error = "photon noise: read_sigma must not be negative";
  } else {
    return true;
  }
  return false;
}

void AddPhotonNoise(const PhotonNoiseOptions& options, uint64_t seed, uint64_t frame,
                    RenderedImage* image) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("AddPhotonNoise: " + error);
  Random random(seed, frame);
  const double photons_per_level = options.light * options.photons_per_level;
  for (uint8_t& value : image->rgb) {
    if (value == 255) continue;
    const double photons = random.Poisson(photons_per_level * value);
    const double read = options.read_sigma / options.light * random.Normal();
    value = ToGrayValue(static_cast<float>(photons / photons_per_level + read));
  }
}

}  // namespace msc_vo
