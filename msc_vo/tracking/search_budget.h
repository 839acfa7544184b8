// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>

namespace msc_vo {

/// Returns how many of the `num_keyframes` of a map are tried in a frame that follows the previous
/// one after `seconds`, so that their number per second, and with it the cost, does not depend on
/// the frame rate: `keyframes_per_interval` in 1/30 s, at least one, and after a gap no more than
/// in 0.2 s. Beyond `keyframes_per_interval`, none is tried twice.
int KeyframesToTry(int keyframes_per_interval, double seconds, size_t num_keyframes);

}  // namespace msc_vo
