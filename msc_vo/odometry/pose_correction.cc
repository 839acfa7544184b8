// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/pose_correction.h"

#include <iterator>
#include <map>
#include <memory>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

// Corrections of the camera poses of one map.
class PoseCorrection {
 public:
  PoseCorrection(const Map& before, const Map& after) : before_(before), after_(after) {
    for (const auto& [id, keyframe] : after.keyframes()) {
      if (after.IsOfEarlierSession(id)) continue;
      corrections_[keyframe.frame->timestamp] =
          keyframe.cam_from_world * before.CamFromWorld(id).Inverse();
    }
  }

  // Of a pose relative to keyframe `reference`.
  Rigid3 Correct(double timestamp, KeyframeId reference, const Rigid3& cam_from_reference) const {
    return At(timestamp) * cam_from_reference * before_.CamFromWorld(reference) *
           after_.CamFromWorld(reference).Inverse();
  }

 private:
  // Maps coordinates of the old camera at `timestamp` (seconds) to those of the new one.
  Rigid3 At(double timestamp) const {
    if (corrections_.empty()) return Rigid3();
    const auto next = corrections_.lower_bound(timestamp);
    if (next == corrections_.begin()) return next->second;
    const auto last = std::prev(next);
    if (next == corrections_.end()) return last->second;
    const double s = (timestamp - last->first) / (next->first - last->first);
    const Rigid3& a = last->second;
    const Rigid3& b = next->second;
    return Rigid3(Eigen::Quaterniond(a.rotation()).slerp(s, Eigen::Quaterniond(b.rotation())),
                  (1.0 - s) * a.translation() + s * b.translation());
  }

  const Map& before_;
  const Map& after_;
  std::map<double, Rigid3> corrections_;  // by time stamp of the keyframe of this session
};

// Interpolates from `a` (s = 0) to `b` (s = 1): the centre along the straight line, the rotation
// about a fixed axis.
Rigid3 Interpolate(const Rigid3& a, const Rigid3& b, double s) {
  const Eigen::Vector3d center = (1.0 - s) * a.OriginInSource() + s * b.OriginInSource();
  const Eigen::Quaterniond rotation =
      ExpSO3(s * LogSO3(b.rotation() * a.rotation().conjugate())) * a.rotation();
  return {rotation, -(rotation * center)};
}

bool AreInOneWorld(const std::vector<Segment>& segments, const FrameResult& a,
                   const FrameResult& b) {
  return a.segment == b.segment || segments[a.segment].world == segments[b.segment].world;
}

}  // namespace

void CorrectPoses(const InactiveMaps& maps_before, const MapSnapshot& after,
                  const std::vector<FrameResult>& frames, std::vector<ReferencedPose>* poses) {
  for (const std::shared_ptr<const Map>& before : maps_before) {
    if (before->keyframes().empty()) continue;
    const KeyframeId first = before->keyframes().front().first;
    const PoseCorrection correction(*before, *after.FindMapOf(first));
    for (size_t i = 0; i < poses->size(); ++i) {
      ReferencedPose& pose = (*poses)[i];
      if (pose.reference == kNoId || !before->KnowsKeyframe(pose.reference)) continue;
      pose.cam_from_reference =
          correction.Correct(frames[i].timestamp, pose.reference, pose.cam_from_reference);
    }
  }
}

void DiscardFrames(int first, std::vector<FrameResult>* frames,
                   std::vector<ReferencedPose>* poses) {
  FrameResult before;
  before.segment = before.world = kNoSegment;
  if (first > 0) before = (*frames)[first - 1];
  const ReferencedPose pose_before = first > 0 ? (*poses)[first - 1] : ReferencedPose();
  for (size_t i = first; i < frames->size(); ++i) {
    Discard(before, &(*frames)[i]);
    (*poses)[i] = pose_before;
  }
}

void ReplacePose(const Rigid3& cam_from_world, FrameResult* frame) {
  if (frame->covariance) {
    frame->covariance = CovarianceOfCamera(
        cam_from_world, CameraCovariance(frame->cam_from_world, *frame->covariance));
  }
  frame->cam_from_world = cam_from_world;
}

void SetPoses(const Atlas& atlas, const std::vector<ReferencedPose>& poses,
              std::vector<FrameResult>* frames) {
  for (size_t i = 0; i < frames->size(); ++i) {
    const ReferencedPose& pose = poses[i];
    const SubMap* submap = pose.reference != kNoId ? atlas.FindSubMapOf(pose.reference) : nullptr;
    if (submap == nullptr) continue;
    (*frames)[i].cam_from_world =
        pose.cam_from_reference * submap->map.CamFromWorld(pose.reference);
  }
}

void FillGaps(const std::vector<Segment>& segments, std::vector<FrameResult>* frames) {
  size_t before = frames->size();  // index of the last frame with an estimate; size(): none
  for (size_t i = 0; i < frames->size(); ++i) {
    if (!IsEstimated((*frames)[i].status) && !(*frames)[i].by_pose_factors) continue;
    const bool is_gap =
        before < frames->size() && AreInOneWorld(segments, (*frames)[before], (*frames)[i]);
    for (size_t gap = before + 1; is_gap && gap < i; ++gap) {
      const FrameResult& a = (*frames)[before];
      const FrameResult& b = (*frames)[i];
      const double s = ((*frames)[gap].timestamp - a.timestamp) / (b.timestamp - a.timestamp);
      (*frames)[gap].cam_from_world = Interpolate(a.cam_from_world, b.cam_from_world, s);
    }
    before = i;
  }
}

}  // namespace msc_vo
