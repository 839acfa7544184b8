// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

namespace msc_vo {

// Calls of operator new so far, in all of the program; memory that OpenCV or C libraries get from
// malloc is not counted.
int64_t NumAllocations();

}  // namespace msc_vo
