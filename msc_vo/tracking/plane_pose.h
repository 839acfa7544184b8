// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/frame_pose.h"

namespace msc_vo {

/// Prior of a pose, used with planes. The covariances are of the camera, in its frame.
struct PlanePosePrior {
  Rigid3 cam_from_world;
  PoseCovariance covariance = PoseCovariance::Zero();
  /// Covariance of an independent error that planes may correct. Where they leave the camera free,
  /// the pose stays, and its covariance contains this error.
  PoseCovariance correctable = PoseCovariance::Zero();
};

/// What is known of the pose of a frame before its image (not in the paper).
struct ExpectedPose {
  Rigid3 cam_from_world;
  PoseCovariance covariance = PoseCovariance::Zero();  ///< tangent of Rigid3Manifold
  /// Covariance of the camera, in its frame, for the directions that planes leave free; none if
  /// custom factors hold it.
  std::optional<PoseCovariance> free;
};

/// The pose behind one of a frame `seconds` before. `velocity`: the motion since then that constant
/// velocity predicts, if it is known. `undetermined_seconds`: since the last frame whose pose was
/// certain in all directions: the sigmas of what planes leave free grow with it.
ExpectedPose ExpectPose(const Rigid3& last_from_world, const PoseCovariance& last_covariance,
                        double seconds, const std::optional<Rigid3>& velocity,
                        double undetermined_seconds);

/// A pose by planes, without points and lines, unless landmarks hold what planes leave free.
struct PlanePose {
  Rigid3 cam_from_world;
  PoseSummary summary;
  std::vector<PlaneMatch> planes;
  FrameMatches landmarks;      ///< inliers
  bool is_determined = false;  ///< in all directions, by planes and landmarks
};

/// Estimates the pose of a frame by its planes and by custom `factors`; std::nullopt if no plane is
/// matched, or if the planes leave a direction free while the frame shows many features, none of
/// which could be matched: one floor is like another.
std::optional<PlanePose> EstimateByPlanes(const TrackerOptions& options, const Frame& frame,
                                          const MapSnapshot& snapshot, const ExpectedPose& expected,
                                          const std::vector<PoseFactor>& factors);

/// Repeats the estimate of a pose by planes that leave directions free, with the landmarks of
/// `local` that match near it, and with the expected pose as a prior. Planes determine at least
/// half of a pose, so that half of `min_matches` suffice. The pose is determined if it is certain
/// without the prior, which would hold each frame at the one before. Returns false, and changes
/// nothing, if too few landmarks agree.
bool HoldByLandmarks(const TrackerOptions& options, const Frame& frame, const MapSnapshot& snapshot,
                     const LocalMap& local, const ExpectedPose& expected,
                     const std::vector<PoseFactor>& factors, PlanePose* pose);

/// Corrects a pose of a frame, which the prior describes, by the matched planes. Returns false, and
/// changes nothing, if there are none or if they give no pose.
bool CorrectByPlanes(const TrackerOptions& options, const Frame& frame,
                     const std::vector<PlaneMatch>& planes, const MapSnapshot& snapshot,
                     const PlanePosePrior& prior, FramePose* pose);

/// Whether the matched planes determine a pose.
bool DetermineAPose(const Frame& frame, const std::vector<PlaneMatch>& matches);

}  // namespace msc_vo
