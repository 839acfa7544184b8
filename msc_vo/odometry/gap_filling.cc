// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/gap_filling.h"

#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

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
