// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

// One row per frame: time, status, features, inliers, keyframe flag, milliseconds per stage, and
// the six sigmas of the pose (rotation vector in the camera frame, radians; translation, metres; 0
// where the pose was not estimated).
std::string FormatFramesCsv(const std::vector<FrameResult>& frames);

// Writes trajectory.txt, keyframes.txt, frames.csv, map.ply, lines.ply, summary.json, report.html
// and, if there is one, groundtruth.txt into `directory`, which is made if it does not exist. Each
// file is complete or as it was before. Throws std::runtime_error naming the file that cannot be
// written.
void WriteResultFiles(const std::string& directory, const OdometryResult& result,
                      const RunContext& context);

}  // namespace msc_vo
