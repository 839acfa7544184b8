// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "apps/python/shared_object.h"
#include "msc_vo/odometry/tracking_observer.h"

namespace msc_vo {

/// The observer that calls a Python function with a TrackedImage, which is valid during the call.
/// Takes the GIL.
TrackingObserver MakeTrackingObserver(const SharedObject& callback);

}  // namespace msc_vo
