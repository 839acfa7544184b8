// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/frame.h"

namespace msc_vo {

/// Points and lines of the frame whose depth was measured.
int NumWithDepth(const Frame& frame);

}  // namespace msc_vo
