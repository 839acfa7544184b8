// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// Called with every window before its local bundle adjustment, and with the keyframe that the
/// window was selected for. Runs on the mapper's thread; an exception ends the keyframe step.
using WindowObserver = std::function<void(
    KeyframeId keyframe, const BundleAdjustmentOptions& options, const WindowData& data)>;

}  // namespace msc_vo
