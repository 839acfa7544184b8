// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// Gives the sessions, submaps, keyframes and landmarks of `second` ids that follow those of
/// `first`, so that ids are unique over both. Keyframes that were removed from its maps are
/// forgotten. Returns what was added to the ids of its keyframes.
KeyframeId RenumberAfter(const MapContents& first, MapContents* second);

}  // namespace msc_vo
