// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/matching/landmark_matchers.h"

namespace msc_vo {

/// The matches of one frame; each feature occurs at most once.
using FrameMatches = ByKind<Matches>;

}  // namespace msc_vo
