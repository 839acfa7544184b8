// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/map/keyframe.h"
#include "msc_vo/map/landmark.h"
#include "msc_vo/map/shared_table.h"

namespace msc_vo {

// Keyframes, landmarks and who sees what. Share() gives snapshots that nobody else changes.
//
// Pointers and references to its parts hold until the next change of the map.
//
// Ids grow in order of creation and are never used again; all containers are ordered by id, so that
// every walk over the map is the same at every run.
class Map {
 public:
  // Keyframes are shared one by one, as their lists of landmarks are long. Blocks of 16 landmarks,
  // 2 kB without observations: few others are copied with one that changes, and a snapshot copies a
  // sixteenth of the pointers.
  using KeyframeTable = SharedTable<Keyframe, 1>;
  using PointTable = SharedTable<PointLandmark, 16>;
  using LineTable = SharedTable<LineLandmark, 16>;

  // Another keyframe and how many landmarks it shares with the one that was asked about.
  struct Covisible {
    KeyframeId keyframe = kNoId;
    int num_shared = 0;
  };

  // The map as it is now, in time and memory of what changes afterwards.
  Map Share();

  const KeyframeTable& keyframes() const { return keyframes_; }
  const PointTable& points() const { return points_; }
  const LineTable& lines() const { return lines_; }

  // nullptr if there is none, or no longer.
  const Keyframe* FindKeyframe(KeyframeId id) const;
  const PointLandmark* FindPoint(LandmarkId id) const;
  const LineLandmark* FindLine(LandmarkId id) const;

  // Adds a keyframe without associations and returns its id.
  KeyframeId AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& cam_from_world);
  // Adds a landmark first seen in `keyframe`'s feature `feature`, observation included.
  LandmarkId AddPoint(KeyframeId keyframe, int feature, const Eigen::Vector3d& position);
  LandmarkId AddLine(KeyframeId keyframe, int feature, const LineSegment3& segment);

  // Adds an observation. Returns false, changing nothing, if the landmark is gone, is seen in this
  // keyframe already, or the feature is taken.
  bool ObservePoint(LandmarkId point, KeyframeId keyframe, int feature);
  bool ObserveLine(LandmarkId line, KeyframeId keyframe, int feature);
  // Removes an observation if it exists; a landmark without any observation goes with it.
  void ForgetPoint(LandmarkId point, KeyframeId keyframe);
  void ForgetLine(LandmarkId line, KeyframeId keyframe);

  void RemovePoint(LandmarkId point);
  void RemoveLine(LandmarkId line);
  // Moves the observations of `from` to `into` where they do not collide, and removes `from`.
  void MergePoints(LandmarkId from, LandmarkId into);
  void MergeLines(LandmarkId from, LandmarkId into);

  // Removes a keyframe and its observations. Its pose relative to `heir`, which must be in the map,
  // is remembered, so that frames tracked against it keep a place on the trajectory.
  void RemoveKeyframe(KeyframeId id, KeyframeId heir);
  // Pose of a keyframe that is in the map or was removed from it.
  Rigid3 CamFromWorld(KeyframeId id) const;

  // Another state of the same features, in the same order.
  void SetFrame(KeyframeId keyframe, std::shared_ptr<const Frame> frame);
  void SetPose(KeyframeId keyframe, const Rigid3& cam_from_world);
  void SetPoint(LandmarkId point, const Eigen::Vector3d& position);
  void SetLine(LandmarkId line, const LineSegment3& segment);
  // Of the landmark's observations.
  void SetPointNoise(LandmarkId point, double noise);
  void SetLineNoise(LandmarkId line, double noise, double depth_offset);
  void CountTracking(LandmarkId landmark, bool is_line, int num_visible, int num_found);

  // Recomputes descriptor, viewing direction and reference distance from the observations.
  void RefreshPoint(LandmarkId point);
  void RefreshLine(LandmarkId line);

  // Keyframes that share landmarks with `keyframe`, most shared first, then newest first.
  std::vector<Covisible> FindCovisible(KeyframeId keyframe) const;

 private:
  // Where a removed keyframe stands; nothing while it is in the map.
  struct Place {
    KeyframeId heir = kNoId;
    Rigid3 cam_from_heir;
  };

  KeyframeTable keyframes_;
  PointTable points_;
  LineTable lines_;
  SharedTable<Place, 16> places_;  // of every keyframe that ever was
  KeyframeId next_keyframe_ = 0;
  LandmarkId next_landmark_ = 0;
};

}  // namespace msc_vo
