// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// One row per frame: time, status, features, inliers, keyframe flag, milliseconds per stage, and
/// the six sigmas of the pose (rotation vector in the camera frame, radians; translation, metres; 0
/// where the pose was not estimated).
std::string FormatFramesCsv(const std::vector<FrameResult>& frames);
/// One of its rows.
std::string FormatFrameRow(const FrameResult& frame);

/// Throws std::runtime_error if results in `directory` would lie among the files of the sequence or
/// overwrite the file `config` (may be empty). For the beginning of a run: not after hours of work.
void RefuseToOverwriteInputs(const SequenceIndex& sequence, const std::string& config,
                             const std::string& directory);

/// Removes the files that WriteResultFiles writes for every sequence, if they exist. Throws
/// std::runtime_error naming the file that cannot be removed.
void RemoveResultFiles(const std::string& directory);

/// Writes trajectory.txt, keyframes.txt, frames.csv, map.ply, lines.ply, summary.json, report.html
/// and, if there is one, groundtruth.txt into `directory`, which is made if it does not exist. Each
/// file is complete or as it was before. Throws std::runtime_error naming the file that cannot be
/// written.
void WriteResultFiles(const std::string& directory, const OdometryResult& result,
                      const RunContext& context);

}  // namespace msc_vo
