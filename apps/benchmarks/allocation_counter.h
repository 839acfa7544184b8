// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

namespace msc_vo {

/// Number of calls of operator new in the program so far. Memory that OpenCV or C libraries
/// allocate with malloc is not counted.
int64_t NumAllocations();

}  // namespace msc_vo
