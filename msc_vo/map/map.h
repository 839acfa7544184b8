// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
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
  template <typename L>
  using LandmarkTable = SharedTable<L, 16>;

  /// Another keyframe and the number of landmarks that it shares with the given one.
  struct Covisible {
    KeyframeId keyframe = kNoId;
    int num_shared = 0;
  };

  /// Returns a snapshot of the map. It shares memory with this map until either changes.
  Map Share();
  /// Returns an empty map whose ids continue those of this map, so that the ids of both differ.
  Map Next() const;
  /// The ids of the next keyframe and of the next landmark.
  KeyframeId next_keyframe() const { return next_keyframe_; }
  LandmarkId next_landmark() const { return next_landmark_; }
  /// Lets the next ids be at least these, so that ids of other maps are not used again.
  void ContinueIds(KeyframeId next_keyframe, LandmarkId next_landmark);
  /// Declares all present keyframes to be of earlier sessions. Keyframes to come, also of maps that
  /// Next() makes, are of the present one. Time stamps of different sessions cannot be compared.
  void BeginSession() { session_begin_ = next_keyframe_; }
  bool IsOfEarlierSession(KeyframeId id) const { return id < session_begin_; }
  /// Adds the keyframes and landmarks of `other`, which must be in the same world and have ids that
  /// differ from those of this map.
  void Merge(const Map& other);
  /// Expresses keyframes and landmarks in another world. Removed keyframes follow their successors.
  void Transform(const Rigid3& new_from_old_world);

  const KeyframeTable& keyframes() const { return keyframes_; }
  /// The landmarks of a kind (landmark_kinds.h).
  template <typename L>
  const LandmarkTable<L>& landmarks() const {
    return landmarks_.Of<L>();
  }
  const LandmarkTable<PointLandmark>& points() const { return landmarks<PointLandmark>(); }
  const LandmarkTable<LineLandmark>& lines() const { return landmarks<LineLandmark>(); }

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

  /// Adds a landmark with its id, which must be higher than those of its kind so far, and its
  /// observations, which must be at least one, in order of keyframes, by features that observe no
  /// other landmark. What Refresh() computes is left to that.
  template <typename L>
  void AddExisting(L landmark);

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
  /// All keyframes that are in the map or were removed from it, ascending. The first one began the
  /// world, unless it was removed before the map was saved.
  std::vector<KeyframeId> KnownKeyframes() const;
  /// Pose of a keyframe that is in the map or was removed from it.
  Rigid3 CamFromWorld(KeyframeId id) const;

  /// The keyframes and landmarks of these setters must be in the map. Geometry is in metres, world.
  /// SetFrame() replaces the frame by one with the same features in the same order.
  void SetFrame(KeyframeId keyframe, std::shared_ptr<const Frame> frame);
  void SetPose(KeyframeId keyframe, const Rigid3& cam_from_world);
  /// Sets the covariance of the keyframe's pose relative to the keyframes before it, as odometry
  /// has measured it: of the camera in its own frame (CameraCovariance). It outlives the keyframe.
  void SetStepCovariance(KeyframeId keyframe, const PoseCovariance& covariance);
  /// nullptr if the map does not know the keyframe. Zero if it was not set.
  const PoseCovariance* StepCovariance(KeyframeId keyframe) const;
  template <typename L>
  void SetGeometry(LandmarkId landmark, const typename L::Geometry& geometry) {
    Table<L>().FindToChange(landmark)->SetGeometry(geometry);
  }
  /// Sets Landmark::noise.
  template <typename L>
  void SetNoise(LandmarkId landmark, double noise) {
    Table<L>().FindToChange(landmark)->noise = noise;
  }
  /// Sets Landmark::has_false_depth.
  template <typename L>
  void SetHasFalseDepth(LandmarkId landmark, bool has_false_depth) {
    if (Find<L>(landmark)->has_false_depth == has_false_depth) return;
    Table<L>().FindToChange(landmark)->has_false_depth = has_false_depth;
  }
  /// Sets LineLandmark::depth_offset.
  void SetDepthOffset(LandmarkId line, double depth_offset) {
    Table<LineLandmark>().FindToChange(line)->depth_offset = depth_offset;
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
    auto& [keyframes, landmarks, relative_poses, steps, next_keyframe, next_landmark,
           session_begin] = *this;  // all members, or it does not compile
    archive(keyframes, landmarks, relative_poses, steps, next_keyframe, next_landmark,
            session_begin);
  }

 private:
  template <typename L>
  LandmarkTable<L>& Table() {
    return landmarks_.Of<L>();
  }
  // Adds or removes an observation where the order by keyframes demands it.
  static void InsertObservation(const Observation& observation, Landmark* landmark);
  static void EraseObservation(KeyframeId keyframe, Landmark* landmark);
  // The descriptor with the smallest total distance to all others; the first one on ties.
  static Descriptor CentralDescriptor(const std::vector<Descriptor>& descriptors);

  // Pose of a removed keyframe relative to its successor; kNoId while the keyframe is in the map.
  struct RelativePose {
    KeyframeId successor = kNoId;
    Rigid3 cam_from_successor;
  };

  KeyframeTable keyframes_;
  ByKind<LandmarkTable> landmarks_;
  SharedTable<RelativePose, 16> relative_poses_;  // of all keyframes ever added
  SharedTable<PoseCovariance, 16> steps_;         // of all keyframes ever added
  KeyframeId next_keyframe_ = 0;
  LandmarkId next_landmark_ = 0;
  KeyframeId session_begin_ = 0;
};

template <typename L>
LandmarkId Map::Add(KeyframeId keyframe, int feature, const typename L::Geometry& geometry) {
  const LandmarkId id = next_landmark_++;
  L landmark;
  landmark.id = id;
  landmark.first_keyframe = keyframe;
  landmark.SetGeometry(geometry);
  Table<L>().Append(id, std::move(landmark));
  Observe<L>(id, keyframe, feature);
  Refresh<L>(id);
  return id;
}

template <typename L>
void Map::AddExisting(L landmark) {
  const LandmarkId id = landmark.id;
  for (const Observation& observation : landmark.observations) {
    Keyframe* const keyframe = keyframes_.FindToChange(observation.keyframe);
    keyframe->landmarks.Of<L>()[observation.feature] = id;
  }
  next_landmark_ = std::max(next_landmark_, id + 1);
  landmark.descriptor_is_current = false;
  Table<L>().Append(id, std::move(landmark));
}

template <typename L>
bool Map::Observe(LandmarkId id, KeyframeId keyframe_id, int feature) {
  const L* landmark = Find<L>(id);
  const Keyframe* keyframe = FindKeyframe(keyframe_id);
  if (landmark == nullptr || keyframe == nullptr) return false;
  if (SlotsOf<L>(*keyframe)[feature] != kNoId) return false;
  if (FindObservation(*landmark, keyframe_id) != nullptr) return false;
  keyframes_.FindToChange(keyframe_id)->landmarks.Of<L>()[feature] = id;
  L* const changed = Table<L>().FindToChange(id);
  InsertObservation({keyframe_id, feature}, changed);
  changed->descriptor_is_current = false;
  return true;
}

template <typename L>
void Map::RemoveObservation(LandmarkId id, KeyframeId keyframe) {
  const L* landmark = Find<L>(id);
  if (landmark == nullptr) return;
  const Observation* observation = FindObservation(*landmark, keyframe);
  if (observation == nullptr) return;
  keyframes_.FindToChange(keyframe)->landmarks.Of<L>()[observation->feature] = kNoId;
  if (landmark->observations.size() == 1) {
    Table<L>().Erase(id);
    return;
  }
  L* const changed = Table<L>().FindToChange(id);
  EraseObservation(keyframe, changed);
  changed->descriptor_is_current = false;
  if (changed->observations.size() == 1) changed->has_false_depth = false;  // has no parallax
}

template <typename L>
void Map::Remove(LandmarkId id) {
  const L* landmark = Find<L>(id);
  if (landmark == nullptr) return;
  for (const Observation& observation : landmark->observations) {
    Keyframe* const keyframe = keyframes_.FindToChange(observation.keyframe);
    keyframe->landmarks.Of<L>()[observation.feature] = kNoId;
  }
  Table<L>().Erase(id);
}

template <typename L>
void Map::MergeLandmarks(LandmarkId from, LandmarkId into) {
  const L source = *Find<L>(from);
  Remove<L>(from);
  for (const Observation& observation : source.observations) {
    Observe<L>(into, observation.keyframe, observation.feature);
  }
  L* const target = Table<L>().FindToChange(into);
  target->num_visible += source.num_visible;
  target->num_found += source.num_found;
  target->has_false_depth |= source.has_false_depth;
}

template <typename L>
void Map::CountTracking(LandmarkId id, int num_visible, int num_found) {
  L* const landmark = Table<L>().FindToChange(id);
  if (landmark == nullptr) return;
  landmark->num_visible += num_visible;
  landmark->num_found += num_found;
}

template <typename L>
void Map::Refresh(LandmarkId id) {
  L* const landmark = Table<L>().FindToChange(id);
  if (!landmark->descriptor_is_current) {
    std::vector<Descriptor> descriptors;
    descriptors.reserve(landmark->observations.size());
    for (const Observation& observation : landmark->observations) {
      const Frame& frame = *keyframes_.Find(observation.keyframe)->frame;
      descriptors.push_back(FeaturesOf<L>(frame)[observation.feature].descriptor);
    }
    landmark->descriptor = CentralDescriptor(descriptors);
    landmark->descriptor_is_current = true;
  }
  landmark->RefreshViews(keyframes_);
}

}  // namespace msc_vo
