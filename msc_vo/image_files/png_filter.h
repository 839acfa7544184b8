// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace msc_vo {

/// Turns the filtered rows of a PNG image into its pixels, in place (PNG specification, section 9).
/// Each row is one byte, the type of its filter, and `row_bytes` bytes; a pixel has 1, 2, 3 or 4
/// bytes. Returns false if a type is unknown.
bool UndoPngFilters(int pixel_bytes, size_t row_bytes, int num_rows, uint8_t* rows);

}  // namespace msc_vo
