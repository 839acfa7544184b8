// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/segment_log.h"

namespace msc_vo {

/// Pose of a frame relative to a keyframe, whose own pose may still change.
struct ReferencedPose {
  KeyframeId reference = kNoId;
  Rigid3 cam_from_reference;
};

/// Corrects the poses of frames after those of the keyframes have changed at once, from
/// `maps_before` to the maps of `after`, because the calibration has. Frames between two keyframes
/// were tracked with the old calibration: their correction is interpolated between those of the
/// keyframes. `frames`: with the time stamps, one per pose.
void CorrectPoses(const InactiveMaps& maps_before, const MapSnapshot& after,
                  const std::vector<FrameResult>& frames, std::vector<ReferencedPose>* poses);

/// Discards the frames from `first` on, of a segment of which no frame but the first was tracked:
/// what its map shows is unknown. They are lost since the segment before it, or have no pose if
/// there is none.
void DiscardFrames(int first, std::vector<FrameResult>* frames, std::vector<ReferencedPose>* poses);

/// Replaces the pose of a frame, as by that in another world. The covariance of the camera in its
/// own frame remains.
void ReplacePose(const Rigid3& cam_from_world, FrameResult* frame);

/// Sets the poses of `frames`, one per pose, from those of their keyframes in the maps of `atlas`.
void SetPoses(const Atlas& atlas, const std::vector<ReferencedPose>& poses,
              std::vector<FrameResult>* frames);

/// Replaces the pose of every frame without an estimate (predicted, lost, dropped, unreadable) by
/// interpolation between its neighbours with one, at constant velocity: more accurate than the
/// prediction from the frames before the gap. A pose that pose factors determined counts as an
/// estimate. Frames before the first estimate or after the last one, between segments whose worlds
/// are not joined, and statuses, do not change. Frames are in order of time.
void FillGaps(const std::vector<Segment>& segments, std::vector<FrameResult>* frames);

}  // namespace msc_vo
