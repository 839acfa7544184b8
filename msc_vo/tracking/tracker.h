// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/tracking/motion_model.h"
#include "msc_vo/tracking/tracked_frame.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

// Estimates the pose of every frame against a snapshot of the map (paper: Tracking), and says which
// frames should become keyframes. Never changes the map.
class Tracker {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit Tracker(const TrackerOptions& options);

  // Tracks the next frame; the one that comes back is unrolled as the map is, if it is known how
  // the camera has moved: not after a gap. Frames come in the order of time; snapshots never get
  // older.
  TrackedFrame Track(std::shared_ptr<const Frame> rolled, const MapSnapshot& snapshot);

  // Of the camera, as the last tracked frames showed it.
  const MotionModel& motion() const { return motion_; }

 private:
  TrackedFrame Initialize(std::shared_ptr<const Frame> frame);
  // The first steps of tracking: each returns false if it did not find a pose.
  bool TrackMotion(const Map& map, const Rigid3& prediction, double radius,
                   TrackedFrame* tracked) const;
  bool TrackReference(const Map& map, const Rigid3& prediction, TrackedFrame* tracked) const;
  bool TrackByAppearance(const Map& map, TrackedFrame* tracked);
  // The second step: against all that the map holds around the pose. Returns false, and leaves the
  // pose as it was, if the map has too little there.
  bool TrackLocalMap(const Map& map, TrackedFrame* tracked) const;

  bool EstimatePose(const PoseOptions& options, const Map& map, TrackedFrame* tracked) const;
  TrackingStatus ClassifyStatus(const TrackedFrame& tracked) const;
  bool IsKeyframeDue(const MapSnapshot& snapshot, const TrackedFrame& tracked);
  // Keeps the frame, and what it tells about the one before, for those to come.
  void Remember(const Rigid3& last_from_world, TrackedFrame* tracked);

  TrackerOptions options_;
  PoseOptions rough_pose_;  // of the first step
  KeyframePolicy policy_;
  MotionModel motion_;
  TrackedFrame last_;                  // the last frame whose pose was estimated
  KeyframeId next_candidate_ = kNoId;  // keyframe at which the search for the map goes on
};

}  // namespace msc_vo
