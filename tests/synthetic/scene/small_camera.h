// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

// A camera whose images are rendered quickly.
inline const PinholeCamera kSmallCamera = KinectCamera(160, 120);

}  // namespace msc_vo
