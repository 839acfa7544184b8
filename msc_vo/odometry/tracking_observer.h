// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <vector>

#include "msc_vo/frame/frame.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/loop_log.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// A frame that has just been tracked, for display. References are valid during the call.
struct TrackedImage {
  const RgbdImage& image;  ///< as passed to Odometry::Process()
  /// Features of the image, undistorted, before the compensation of the rolling shutter. Indices
  /// are those of `tracked`.
  const Frame& features;
  const TrackedFrame& tracked;
  const MapSnapshot& map;  ///< the map that the frame was tracked in
  const FrameResult& result;
  const std::vector<Loop>& loops;  ///< closed so far, in order of time
};

/// Called with every frame that Odometry::Process() has tracked, in the thread of the caller.
using TrackingObserver = std::function<void(const TrackedImage&)>;

}  // namespace msc_vo
