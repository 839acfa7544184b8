// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

// The motion that alignments find.
inline const Rigid3 kTruth(ExpSO3({0.9, -1.3, 0.4}), {1.0, -2.0, 3.0});

}  // namespace msc_vo
