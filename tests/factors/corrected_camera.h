// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "tests/support/factor_checks.h"

#include "msc_vo/camera/sensor_correction.h"

namespace msc_vo {

/// A camera with a lens, for factors that depend on a SensorCorrection.
inline const CorrectedCamera kCorrectedCamera({525.0, 520.0, 320.0, 240.0, 640, 480},
                                              LensDistortion{{0.05, -0.02, 0.001, -0.001, 0.01}});

/// A random correction of all parameters.
inline SensorCorrection::Vector AnyCorrection(RandomGeometry* random) {
  SensorCorrection::Vector scale;
  scale << 0.03, 0.01, 0.01, 0.03, 0.02, 0.05, 0.01, 0.01, 0.01, 0.02, 0.02, 0.005, 0.01;
  SensorCorrection::Vector correction;
  for (int i = 0; i < SensorCorrection::kSize; ++i) correction(i) = scale(i) * random->Normal();
  return correction;
}

/// A correction as a parameter block.
inline std::vector<double> CorrectionBlock(const SensorCorrection::Vector& correction) {
  return {correction.data(), correction.data() + correction.size()};
}

}  // namespace msc_vo
