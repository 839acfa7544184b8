// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/map_joiner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/geometry/motion_limits.h"
#include "msc_vo/mapping/map_correction.h"
#include "msc_vo/structure/axis_association.h"

namespace msc_vo {

namespace {

// Whether most lines of a map follow its axes: a building may have wings with axes of their
// own, and maps of different wings have different axes.
bool IsManhattan(const SubMap& submap) {
  constexpr double kMinRatio = 2.0 / 3.0;
  if (submap.axes.estimator().state() != AxesState::kRefined) return false;
  int num_certain = 0, num_along_axes = 0;
  for (const auto& [id, line] : submap.map.lines()) {
    if (!(line.direction_sigma <= kMaxAxisAngle)) continue;
    ++num_certain;
    if (submap.axes.AxisOf(line)) ++num_along_axes;
  }
  return num_along_axes > 0 && num_along_axes >= kMinRatio * num_certain;
}

// Whether the Manhattan axes of two worlds are parallel, up to their covariances, or one of the
// worlds has none.
bool HaveSameAxes(const SubMap& a, const SubMap& b, const MapAlignment& alignment) {
  if (!IsManhattan(a) || !IsManhattan(b)) return true;
  const AxesEstimator &axes_a = a.axes.estimator(), &axes_b = b.axes.estimator();
  const Eigen::Quaterniond axes_a_from_b = axes_a.world_from_axes().conjugate() *
                                           alignment.a_from_b.rotation() * axes_b.world_from_axes();
  // Of the axis that is farthest from all axes of the other world.
  const Eigen::Matrix3d cosines = axes_a_from_b.toRotationMatrix().cwiseAbs();
  const double angle = std::acos(std::min(1.0, cosines.colwise().maxCoeff().minCoeff()));
  const double variance = axes_a.sigma() * axes_a.sigma() + axes_b.sigma() * axes_b.sigma() +
                          alignment.covariance.topLeftCorner<3, 3>().trace() / 3.0;
  return angle * angle <= kOutlierChiSquare[3] * variance;
}

}  // namespace

void MapJoiner::AppendPoses(const Map& map, const Rigid3& map_from_world,
                            std::vector<PoseInMap>* poses) const {
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (map.IsOfEarlierSession(id)) continue;
    poses->push_back(
        {keyframe.frame->timestamp, keyframe.cam_from_world * map_from_world, &map, false});
  }
  for (const LastTrackedPose& last : last_poses_) {
    if (!map.KnowsKeyframe(last.reference)) continue;
    const Rigid3 cam_from_map = last.cam_from_reference * map.CamFromWorld(last.reference);
    poses->push_back({last.timestamp, cam_from_map * map_from_world, &map, true});
  }
}

bool MapJoiner::IsPossibleMotion(const Map& a, const Map& b, const Rigid3& a_from_b) const {
  std::vector<PoseInMap> poses;
  AppendPoses(a, a_from_b, &poses);
  AppendPoses(b, Rigid3(), &poses);
  // Stable: a keyframe that is also the last pose comes before that.
  std::stable_sort(poses.begin(), poses.end(), [](const PoseInMap& first, const PoseInMap& second) {
    return first.timestamp < second.timestamp;
  });
  MotionLimits limits;
  std::vector<CameraVelocity> between_maps;
  for (size_t i = 1; i < poses.size(); ++i) {
    const PoseInMap &from = poses[i - 1], &to = poses[i];
    const double seconds = to.timestamp - from.timestamp;
    if (!(seconds > 0.0)) continue;
    const CameraVelocity velocity =
        CameraVelocity::Of(to.cam_from_world * from.cam_from_world.Inverse(), seconds);
    if (from.map != to.map) {
      between_maps.push_back(velocity);
    } else if (!from.is_last && !to.is_last) {
      // After a last pose there is a gap, and its own image is often a bad one.
      limits.Observe(velocity);
    }
  }
  return std::all_of(between_maps.begin(), between_maps.end(),
                     [&](const CameraVelocity& velocity) { return limits.Allow(velocity); });
}

void MapJoiner::Forget(const std::vector<KeyframeRevisit>& keyframes,
                       const std::vector<bool>& forgotten) {
  for (size_t i = 0; i < keyframes.size(); ++i) {
    if (!forgotten[i]) continue;
    const KeyframeId id = keyframes[i].keyframe;
    EraseIf(&common_keyframes_,
            [id](const KeyframeRevisit& common) { return common.keyframe == id; });
  }
}

std::vector<KeyframeRevisit> MapJoiner::CommonKeyframesWith(const Map& map) const {
  std::vector<KeyframeRevisit> common_keyframes;
  for (const KeyframeRevisit& common : common_keyframes_) {
    if (map.KnowsKeyframe(common.revisit.reference)) common_keyframes.push_back(common);
  }
  return common_keyframes;
}

std::optional<MapJoin> MapJoiner::TryJoin(Atlas* atlas) {
  if (common_keyframes_.empty()) return std::nullopt;
  const KeyframeId reference = common_keyframes_.back().revisit.reference;
  const SubMap* inactive = atlas->FindSubMapOf(reference);
  if (inactive == nullptr || inactive == &atlas->current()) return std::nullopt;
  const SubMap& current = atlas->current();
  const bool inactive_is_kept = IsOlder(*inactive, current);
  const std::vector<KeyframeRevisit> in_both = CommonKeyframesWith(inactive->map);
  std::vector<FrameInTwoMaps> frames;  // a: the map that is moved, b: the one that is kept
  for (const KeyframeRevisit& common : in_both) {
    FrameInTwoMaps frame = InTwoMaps(common, current.map, inactive->map);
    if (!inactive_is_kept) {
      std::swap(frame.cam_from_a, frame.cam_from_b);
      std::swap(frame.covariance_a, frame.covariance_b);
    }
    frames.push_back(frame);
  }
  const std::optional<MapAlignment> alignment = AlignMaps(frames);
  if (!alignment) return std::nullopt;
  const SubMap& moved = inactive_is_kept ? current : *inactive;
  const SubMap& kept = inactive_is_kept ? *inactive : current;
  if (!IsPossibleMotion(moved.map, kept.map, alignment->a_from_b) ||
      !HaveSameAxes(moved, kept, *alignment)) {
    Forget(in_both, alignment->inliers);
    ++num_refused_;
    return std::nullopt;
  }

  const MapJoin join{
      kept.id, moved.id, alignment->a_from_b, alignment->covariance,
      static_cast<int>(std::count(alignment->inliers.begin(), alignment->inliers.end(), true))};
  atlas->Join(reference, inactive_is_kept ? join.moved_from_kept : join.moved_from_kept.Inverse());
  Map* const map = &atlas->current().map;
  for (size_t i = 0; i < in_both.size(); ++i) {
    const KeyframeId keyframe = in_both[i].keyframe;
    if (!alignment->inliers[i] || map->FindKeyframe(keyframe) == nullptr) continue;
    MergeMatches(keyframe, in_both[i].revisit.matches, map);
  }
  EraseIf(&common_keyframes_, [map](const KeyframeRevisit& common) {
    return map->KnowsKeyframe(common.revisit.reference);
  });
  return join;
}

}  // namespace msc_vo
