// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/frame.h"

namespace msc_vo {

/// Number of features with a depth, of all kinds.
int NumWithDepth(const Frame& frame);

/// Whether a feature is on a dynamic object.
bool HasDynamicFeatures(const Frame& frame);

/// Whether a map can begin with the frame: it has at least `min_features` features with a depth, or
/// five lines with a depth in two directions, which determine a pose without any point.
bool CanBeginMap(const Frame& frame, int min_features);

}  // namespace msc_vo
