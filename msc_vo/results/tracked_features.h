// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/report/frame_view.h"
#include "msc_vo/report/report.h"

namespace msc_vo {

/// The features of a tracked image that were matched with the map, at the pixels of the recorded
/// image. Lines have the color of the Manhattan axes as known when the frame was tracked.
ViewedFeatures TrackedFeatures(const TrackedImage& tracked, const LensDistortion& distortion);

/// The features of a keyframe that observe landmarks of its map, in the same way. They are where
/// rolling-shutter compensation has moved them.
ViewedFeatures ObservedFeatures(const Keyframe& keyframe, const Map& map,
                                const std::optional<AxesEstimate>& axes);

/// The map that a frame was tracked in. The keyframes of earlier runs are one session.
ReportMap ViewedMap(const MapSnapshot& snapshot);

}  // namespace msc_vo
