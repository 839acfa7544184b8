// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

// Is shown every window that the mapper is about to solve, with the keyframe that it was selected
// for. Runs where the mapper runs; what it throws ends the step.
using WindowObserver = std::function<void(
    KeyframeId keyframe, const BundleAdjustmentOptions& options, const WindowData& data)>;

}  // namespace msc_vo
