// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/plane_landmark.h"

namespace msc_vo {

/// The planes of a submap and the keyframes that observe them. A plane is kept in the camera frame
/// of a keyframe that observed it, its host, and moves with it when the map is corrected. In a
/// window, planes are extra blocks with ids below kFirstBlock, tied to the keyframes by
/// PlaneObservation.
class PlaneMap {
 public:
  /// Ids of extra blocks below this one are planes.
  static constexpr int64_t kFirstBlock = -(int64_t{1} << 62);

  /// Matches the planes of a keyframe of the map, adds those that are new, extends the others by
  /// what the keyframe shows of them, and merges duplicates. `covariance`: of the keyframe's pose,
  /// camera frame (CameraCovariance()).
  void AddKeyframe(const Map& map, KeyframeId keyframe, const PoseCovariance& covariance);
  /// Merges planes that a keyframe observes with others that are the same within the uncertainty
  /// of the observation, and whose extents touch. Does nothing if the keyframe is unknown.
  void MergeDuplicates(const Map& map, KeyframeId keyframe);
  /// Forgets keyframes that were culled, and the planes that only they observed.
  void Renew(const Map& map);
  /// Takes over the planes of a map that was joined with that of this one, under other ids; the
  /// keyframes of both are in one map now.
  void Join(PlaneMap other);
  /// Forgets the observations of keyframes that are not of earlier sessions, the planes that only
  /// they observed, and the noise. The other planes are determined anew, each with its host and
  /// extent, from the observations that remain.
  void RemoveKeyframesOfThisRun(const Map& map);
  /// Takes the planes with a single observation from it again: the frame of its keyframe may have
  /// been replaced, as by another compensation.
  void FollowFrames(const Map& map);

  /// Adds the planes that two or more keyframes of the window observe.
  void AddTo(const Map& map, WindowData* window) const;
  /// Takes over the estimates of a solved window whose keyframes have been written to the map, and
  /// learns the noise from its residuals.
  void Learn(const Map& map, const WindowData& window);

  /// With every plane fitted to all keyframes that observe it, at the poses that these have: the
  /// estimate of a window is that of its keyframes, and far from these, a large wall is elsewhere.
  PlaneMap Fitted(const Map& map) const;

  /// The planes in the world of the map.
  MapPlanes InWorld(const Map& map) const;
  bool empty() const { return planes_.empty(); }
  /// The number of keyframes that observe each plane.
  std::map<LandmarkId, int> NumObservations() const;

  /// The planes of the keyframes that are in the map, Fitted() and hosted by these, for a map file.
  SavedPlanes Save(const Map& map) const;
  void Restore(const SavedPlanes& saved);

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [planes, keyframes, next, noise, numbering] = *this;  // all members
    archive(planes, keyframes, next, noise, numbering);
  }

 private:
  void Grow(const Map& map, const Keyframe& keyframe, const PlaneMatch& match);
  bool AreSame(const Map& map, const Keyframe& keyframe, const PlaneMatch& match,
               LandmarkId other) const;
  void Replace(const Map& map, LandmarkId replaced, LandmarkId kept);

  std::map<LandmarkId, HostedPlane> planes_;
  std::map<KeyframeId, std::vector<PlaneMatch>> keyframes_;
  LandmarkId next_ = 0;
  double noise_ = 1.0;
  int64_t numbering_ = 0;
};

}  // namespace msc_vo
