// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/odometry/pose_correction.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

struct TrackedFrame;

/// Estimates the pose of each frame a second time, some seconds later (not in the paper): other
/// keyframes have observed its landmarks since, and bundle adjustment has moved them.
class PoseRefiner {
 public:
  /// `delay`: seconds; 0: poses are not estimated again.
  PoseRefiner(const PoseOptions& options, double delay);

  /// Keeps what the frame with result `index`, tracked in `snapshot`, observes, unless it becomes a
  /// keyframe, whose pose bundle adjustment estimates, or pose factors took part in its pose.
  void Add(int index, const TrackedFrame& tracked, const MapSnapshot& snapshot);

  /// Estimates the poses of kept frames that are older than the delay at `timestamp` (seconds), at
  /// most three of them, and forgets the frames. Keeps a pose if its map or its segment is
  /// gone, if few of the observed landmarks are left, or if fewer than half of the observations fit
  /// another pose; if depth was unregistered at the frame, only surviving landmarks count.
  void Refine(double timestamp, const MapSnapshot& snapshot, std::vector<ReferencedPose>* poses);
  /// The same for all kept frames, and keeps them.
  void RefineAll(const MapSnapshot& snapshot, std::vector<ReferencedPose>* poses) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, delay, frames] = *this;  // all members, or it does not compile
    archive(frames);
  }

 private:
  // What a frame whose pose is to be estimated again observes.
  struct PendingFrame {
    int index = 0;
    KeyframeId reference = kNoId;
    std::shared_ptr<const Frame> frame;          // with the matched features alone
    PerKind<std::vector<LandmarkId>> landmarks;  // one per feature
    std::vector<PlaneMatch> planes;
    SubMapId world = 0;           // that `planes` are in
    int64_t plane_numbering = 0;  // MapPlanes::numbering of their ids
  };

  static bool HasPlanes(const PendingFrame& pending, const Frame& frame,
                        const MapSnapshot& snapshot);
  static int NumExpected(const PendingFrame& pending, const Frame& frame,
                         const FrameMatches& matches);
  void RefineFrame(const PendingFrame& pending, const MapSnapshot& snapshot,
                   ReferencedPose* pose) const;

  PoseOptions options_;
  double delay_;
  std::deque<PendingFrame> frames_;
};

}  // namespace msc_vo
