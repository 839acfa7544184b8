// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/report/report.h"

namespace msc_vo {

/// Camera centres by odometry alone (FrameResult::cam_from_odometry), metres, one per frame, moved
/// by `to_from_world`. Each segment begins at its first estimated pose of the final trajectory. NaN
/// before that, and in the last frame before the next segment begins.
std::vector<Eigen::Vector3d> OdometryPath(const std::vector<FrameResult>& frames,
                                          const Rigid3& to_from_world);

/// The keyframes of earlier sessions in the worlds of the run's poses, or in that of the map if no
/// frame has a pose, moved by `to_from_world`.
std::vector<ReportSession> EarlierSessions(const OdometryResult& result,
                                           const Rigid3& to_from_world);

}  // namespace msc_vo
