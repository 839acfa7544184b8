// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

// Published calibration of TUM RGB-D freiburg1.
inline const PinholeCamera kFreiburg1{517.306408, 516.469215, 318.643040, 255.313989, 640, 480};
inline const LensDistortion kFreiburg1Lens{{0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};

}  // namespace msc_vo
