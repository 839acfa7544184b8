// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Whether images with this median depth, metres, can be of an RGB-D camera: otherwise no feature
/// has a usable depth, and the unit of the values is another one.
inline bool IsUsableDepth(double median) { return median >= 0.1 && median <= 40.0; }

}  // namespace msc_vo
