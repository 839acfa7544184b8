// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/frame.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/matching/frame_matches.h"
#include "msc_vo/pose_estimation/pose_optimization.h"
#include "msc_vo/tracking/tracking_status.h"

namespace msc_vo {

// What tracking found out about one frame. The pose is told relative to a keyframe: the mapper may
// move that keyframe later, and the frame moves with it.
struct TrackedFrame {
  std::shared_ptr<const Frame> frame;
  TrackingStatus status = TrackingStatus::kLost;
  KeyframeId reference = kNoId;  // kNoId: no map yet, and cam_from_reference is cam_from_world
  Rigid3 cam_from_reference;
  Rigid3 cam_from_world;  // with the reference where the snapshot has it
  FrameMatches matches;   // inliers among the landmarks
  // Matches with what moves by itself, and the parts of the image that move, at the step that found
  // most of them.
  int num_dynamic = 0;
  std::vector<bool> dynamic_cells;  // of ImageGrid; empty if nothing moves
  // Landmarks that should have been seen, matched ones included: for culling.
  std::vector<LandmarkId> visible_points;
  std::vector<LandmarkId> visible_lines;
  NoiseScale noise_scale;  // of the sigmas of its features
  PoseSummary pose;
  bool is_keyframe = false;
  // Of the frame before, where that became a keyframe: better than it was known then.
  std::optional<CameraVelocity> last_keyframe_velocity;
  double matching_ms = 0.0;
  double pose_ms = 0.0;
};

}  // namespace msc_vo
