// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

/// Noise of an image sensor in dim light, which is compensated by gain. Replaces every grey value g
/// of each colour by (n / 4 + e) / light, where n is a Poisson deviate of mean light * 4 * g (a
/// grey value in full light is 4 detected photons), and e a normal deviate of 1.2 grey values. The
/// variance is therefore g / (4 * light) + (1.2 / light)^2. Saturated values (255) stay.
/// Deterministic for a given seed and frame. `light`: fraction of the light of a well-lit scene,
/// more than 0 and at most 1.
void AddPhotonNoise(double light, uint64_t seed, uint64_t frame, RenderedImage* image);

/// Automatic exposure that hunts, and vignetting of the lens. Multiplies the grey values of an
/// image taken `seconds` after the start by (1 + 0.6 sin(2 pi seconds / 1.9)) (1 - 0.55 r^2), with
/// the distance r from the centre in half diagonals. Bright pixels saturate.
void ApplyHuntingExposure(double seconds, RenderedImage* image);

}  // namespace msc_vo
