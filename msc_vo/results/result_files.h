// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {

/// The contents of frames.csv, one row per frame: time, status, keyframe flag, features, inliers,
/// milliseconds per stage, standard deviations of the pose (rotation vector in the camera frame in
/// degrees, translation in metres; 0 if the pose was not estimated), matches on dynamic objects,
/// number of the segment (-1: the frame precedes the first one and has no pose).
std::string FormatFramesCsv(const std::vector<FrameResult>& frames);
/// A single row of it.
std::string FormatFrameRow(const FrameResult& frame);

/// The names of the files that a run may write into its folder of results.
std::vector<std::string> ResultFileNames();

/// Throws std::runtime_error if results in `directory` would be written into a folder of the
/// sequence or over one of `files` (may be empty). Call before the run, so that no work is lost.
void RefuseToOverwriteInputs(const SequenceIndex& sequence, const std::vector<std::string>& files,
                             const std::string& directory);

/// Removes existing result files before a run of a sequence. groundtruth.txt and reference.txt,
/// which not every run writes, are removed if the results are those of another sequence. Throws
/// std::runtime_error naming the file that cannot be removed.
void RemoveResultFiles(const std::string& directory, const SequenceIdentity& sequence);

/// Writes trajectory.txt, keyframes.txt, frames.csv, summary.json, map.ply, lines.ply and, if there
/// are planes, planes.ply, then what only helps: with ground truth, groundtruth.txt; report.html.
/// Creates `directory` if necessary. A file that cannot be written does not keep the others from
/// being written. A file is replaced only once its new contents are complete, unless the disk is
/// full. `make_room`: called if it is, for one of these; may be empty. Returns why files of
/// the second kind could not be written; empty if all are. Throws std::runtime_error naming the
/// files of the first kind that could not be written.
[[nodiscard]] std::string WriteResultFiles(const std::string& directory,
                                           const OdometryResult& result, const RunContext& context,
                                           const MakeRoom& make_room = {});

}  // namespace msc_vo
