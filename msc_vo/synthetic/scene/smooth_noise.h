// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo {

/// Normal noise of unit variance, correlated by a Gaussian of `sigma` pixels; width * height
/// values, row by row.
std::vector<float> SmoothNoise(int width, int height, double sigma, Random* random);

}  // namespace msc_vo
