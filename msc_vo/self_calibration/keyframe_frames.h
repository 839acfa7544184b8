// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

/// Smallest change of the readout time, seconds, for which frames are compensated again: at 70
/// degrees per second, a millisecond shifts the first and the last row by 0.3 px, less than the
/// sigma of a point.
constexpr double kMinReadoutChange = 0.001;

/// Gives a keyframe other intrinsics.
using KeyframeUpdate =
    std::function<std::shared_ptr<const Frame>(KeyframeId, const std::shared_ptr<const Frame>&)>;

/// Updates all keyframes, and moves every landmark to the position that the first of its
/// observations with a depth measures. Poses remain; the map should be optimised. Landmarks that an
/// earlier session has observed remain as well: the calibration of that is not in question.
void ChangeKeyframeIntrinsics(const KeyframeUpdate& update, Map* map);

/// Expresses all keyframes in another camera (ChangeCamera()). Landmarks remain.
void ChangeKeyframeCamera(const PinholeCamera& camera, Map* map);

/// Replaces the velocity of a keyframe, repeats its rolling-shutter compensation with the readout
/// time that it was compensated with, and moves its planes by SetDepthVelocity(). No effect if the
/// map does not contain the keyframe.
void SetKeyframeVelocity(KeyframeId keyframe, const CameraVelocity& velocity, Map* map);

/// Returns the frame compensated with `readout_time` (seconds) and its own velocity. Returns the
/// frame itself if its velocity is unknown or its readout time differs by less than a millisecond.
std::shared_ptr<const Frame> UpdateCompensation(std::shared_ptr<const Frame> frame,
                                                double readout_time);

/// Applies UpdateCompensation() to all keyframes: an earlier estimate of the readout time may have
/// been used for them, or their velocity was unknown. Landmarks that no other keyframe observes
/// move to their position in the new frame, so that tracking finds them there before the next local
/// bundle adjustment.
void CompensateKeyframes(double readout_time, Map* map);

}  // namespace msc_vo
