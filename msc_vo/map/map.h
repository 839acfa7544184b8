// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/map/keyframe.h"
#include "msc_vo/map/landmark_kinds.h"
#include "msc_vo/map/shared_table.h"

namespace msc_vo {

/// Returns the observation of `landmark` by `keyframe`; nullptr if there is none.
const Observation* FindObservation(const Landmark& landmark, KeyframeId keyframe);

/// Keyframes, landmarks and their observations. Share() returns immutable snapshots.
///
/// Pointers and references into the map are valid until its next change.
///
/// Ids increase in order of creation and are never reused. All containers are ordered by id, so
/// that iteration is deterministic.
class Map {
 public:
  /// Block sizes of the copy-on-write tables. Keyframes have long lists of landmarks and are shared
  /// one by one. Sixteen landmarks take 2 kB without observations: few neighbours are copied with
  /// one that changes, and a snapshot copies a sixteenth of the pointers.
  using KeyframeTable = SharedTable<Keyframe, 1>;
  using PointTable = SharedTable<PointLandmark, 16>;
  using LineTable = SharedTable<LineLandmark, 16>;

  /// Another keyframe and the number of landmarks that it shares with the given one.
  struct Covisible {
    KeyframeId keyframe = kNoId;
    int num_shared = 0;
  };

  /// Returns a snapshot of the map. It shares memory with this map until either changes.
  Map Share();
  /// Returns an empty map whose ids continue those of this map, so that the ids of both differ.
  Map Next() const;
  /// Adds the keyframes and landmarks of `other`, which must be in the same world and have ids that
  /// differ from those of this map.
  void Merge(const Map& other);
  /// Expresses keyframes and landmarks in another world. Removed keyframes follow their successors.
  void Transform(const Rigid3& new_from_old_world);

  const KeyframeTable& keyframes() const { return keyframes_; }
  const PointTable& points() const { return points_; }
  const LineTable& lines() const { return lines_; }
  /// The landmarks of a kind (landmark_kinds.h).
  template <typename L>
  const SharedTable<L, 16>& landmarks() const {
    return const_cast<Map*>(this)->Table<L>();
  }

  /// Returns nullptr if the map does not contain the id.
  const Keyframe* FindKeyframe(KeyframeId id) const;
  template <typename L>
  const L* Find(LandmarkId id) const {
    return landmarks<L>().Find(id);
  }

  /// Adds a keyframe without associations and returns its id: `id`, which must be higher than those
  /// of the keyframes so far, or the next one if it is kNoId.
  KeyframeId AddKeyframe(std::shared_ptr<const Frame> frame, const Rigid3& cam_from_world,
                         KeyframeId id = kNoId);
  /// Adds a landmark (metres, world) and its observation by feature `feature` of `keyframe`.
  template <typename L>
  LandmarkId Add(KeyframeId keyframe, int feature, const typename L::Geometry& geometry);

  /// Adds an observation. Returns false and changes nothing if the landmark does not exist, is
  /// already observed by this keyframe, or the feature observes another landmark.
  template <typename L>
  bool Observe(LandmarkId landmark, KeyframeId keyframe, int feature);
  /// Removes an observation if it exists, and the landmark with its last observation.
  template <typename L>
  void RemoveObservation(LandmarkId landmark, KeyframeId keyframe);

  template <typename L>
  void Remove(LandmarkId landmark);
  /// Moves the observations of `from` to `into` where they do not collide, and removes `from`. Both
  /// must be in the map.
  template <typename L>
  void MergeLandmarks(LandmarkId from, LandmarkId into);

  /// Removes a keyframe and its observations. Its pose relative to `successor`, which must be in
  /// the map, is kept, so that frames that were tracked relative to it keep their pose.
  void RemoveKeyframe(KeyframeId id, KeyframeId successor);
  /// Whether the keyframe is in the map or was removed from it.
  bool KnowsKeyframe(KeyframeId id) const;
  /// Pose of a keyframe that is in the map or was removed from it.
  Rigid3 CamFromWorld(KeyframeId id) const;

  /// The keyframes and landmarks of these setters must be in the map. Geometry is in metres, world.
  /// SetFrame() replaces the frame by one with the same features in the same order.
  void SetFrame(KeyframeId keyframe, std::shared_ptr<const Frame> frame);
  void SetPose(KeyframeId keyframe, const Rigid3& cam_from_world);
  template <typename L>
  void SetGeometry(LandmarkId landmark, const typename L::Geometry& geometry) {
    Table<L>().FindToChange(landmark)->SetGeometry(geometry);
  }
  /// Sets Landmark::noise.
  template <typename L>
  void SetNoise(LandmarkId landmark, double noise) {
    Table<L>().FindToChange(landmark)->noise = noise;
  }
  /// Sets LineLandmark::depth_offset.
  void SetDepthOffset(LandmarkId line, double depth_offset) {
    lines_.FindToChange(line)->depth_offset = depth_offset;
  }
  /// Adds to Landmark::num_visible and num_found; no effect if the landmark does not exist.
  template <typename L>
  void CountTracking(LandmarkId landmark, int num_visible, int num_found);

  /// Recomputes descriptor, viewing direction and what else depends on the observations.
  template <typename L>
  void Refresh(LandmarkId landmark);

  /// Keyframes that share landmarks with `keyframe`, which must be in the map: most shared first,
  /// then newest first.
  std::vector<Covisible> FindCovisible(KeyframeId keyframe) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [keyframes, points, lines, relative_poses, next_keyframe, next_landmark] =
        *this;  // all members, or it does not compile
    archive(keyframes, points, lines, relative_poses, next_keyframe, next_landmark);
  }

 private:
  template <typename L>
  SharedTable<L, 16>& Table();
  void RefreshViews(PointLandmark* point) const;
  void RefreshViews(LineLandmark* line) const;

  // Pose of a removed keyframe relative to its successor; kNoId while the keyframe is in the map.
  struct RelativePose {
    KeyframeId successor = kNoId;
    Rigid3 cam_from_successor;

    template <typename Archive>
    void Serialize(Archive& archive) {
      archive.Fields(*this, successor, cam_from_successor);
    }
  };

  KeyframeTable keyframes_;
  PointTable points_;
  LineTable lines_;
  SharedTable<RelativePose, 16> relative_poses_;  // of all keyframes ever added
  KeyframeId next_keyframe_ = 0;
  LandmarkId next_landmark_ = 0;
};

template <>
inline Map::PointTable& Map::Table<PointLandmark>() {
  return points_;
}
template <>
inline Map::LineTable& Map::Table<LineLandmark>() {
  return lines_;
}

}  // namespace msc_vo
