// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/report_paths.h"

#include <limits>
#include <set>
#include <utility>

namespace msc_vo {

std::vector<Eigen::Vector3d> OdometryPath(const std::vector<FrameResult>& frames,
                                          const Rigid3& to_from_world) {
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Eigen::Vector3d> path(frames.size(), none);
  int segment = kNoSegment;  // that `to_from_odometry` is for
  Rigid3 to_from_odometry;
  for (size_t i = 0; i < frames.size(); ++i) {
    const FrameResult& frame = frames[i];
    if (frame.segment == kNoSegment) continue;
    if (frame.segment != segment) {
      if (!IsEstimated(frame.status)) continue;
      segment = frame.segment;
      to_from_odometry = to_from_world * frame.WorldFromOdometry();
      if (i > 0) path[i - 1] = none;
    }
    path[i] = to_from_odometry * frame.cam_from_odometry.OriginInSource();
  }
  return path;
}

std::vector<ReportSession> EarlierSessions(const OdometryResult& result,
                                           const Rigid3& to_from_world) {
  std::set<int> worlds;
  for (const FrameResult& frame : result.frames) {
    if (frame.world != kNoSegment) worlds.insert(frame.world);
  }
  if (worlds.empty()) worlds.insert(result.map_world);
  std::vector<ReportSession> sessions;
  for (const SessionPath& path : result.earlier_sessions) {
    if (worlds.count(path.world) == 0) continue;
    ReportSession session{path.name, {}};
    for (const Rigid3& world_from_cam : path.world_from_cam) {
      session.positions.push_back(to_from_world * world_from_cam.translation());
    }
    sessions.push_back(std::move(session));
  }
  return sessions;
}

}  // namespace msc_vo
