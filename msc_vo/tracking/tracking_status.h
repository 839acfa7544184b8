// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

enum class TrackingStatus {
  kTracked,  ///< pose from enough matches with the local map
  kWeak,     ///< pose with a large covariance, or implausible after a gap, or soon after such a one
  kPredicted,   ///< no pose from the image, but from pose factors or a short extrapolation
  kLost,        ///< no pose for longer than that
  kDropped,     ///< real time: the image came too late and was not processed
  kUnreadable,  ///< the image file is missing or damaged
};

const char* ToString(TrackingStatus status);

/// Whether the pose comes from the image of the frame itself: tracked or weak. Any other pose is
/// predicted, repeated, or interpolated between the neighbours.
bool IsEstimated(TrackingStatus status);

/// Whether the image of the frame was processed: neither dropped nor unreadable.
bool HasImage(TrackingStatus status);

}  // namespace msc_vo
