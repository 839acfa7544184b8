// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

/// First line of the trajectory.txt of a run that is still in progress or was killed.
extern const char kUnfinishedTrajectoryComment[];

/// Writes sequence.json, trajectory.txt and frames.csv while a run is in progress, so that they
/// remain if it is killed. Every frame is on disk, as first estimated, when Add() returns;
/// WriteResultFiles replaces the last two by the final ones. trajectory.txt contains tracked and
/// weak frames, frames.csv all.
class OnlineResults {
 public:
  /// Creates no file.
  OnlineResults(std::string directory, SequenceIdentity sequence)
      : directory_(std::move(directory)), sequence_(std::move(sequence)) {}

  /// The first readable image creates the folder and removes the result files of an earlier run.
  /// Throws std::runtime_error naming the file that cannot be written; the next call tries again,
  /// with all frames that are not on disk yet.
  void Add(const FrameResult& frame);

  /// Continues the files of a run that has been resumed with `frames`. What is on disk about later
  /// frames remains until they have been computed again. Call before Add().
  void Continue(const std::vector<FrameResult>& frames);

 private:
  void AddUnwritten(const FrameResult& frame);
  void Write();

  std::string directory_;
  SequenceIdentity sequence_;
  std::optional<GrowingFile> trajectory_;
  std::optional<GrowingFile> frames_;
  // Rows and poses that are not on disk yet: of unreadable images before the first readable one,
  // of a resumed run, and those that could not be written.
  std::string unwritten_rows_;
  std::string unwritten_poses_;
  TimedPose last_pose_;  // of those on disk and those that are not
  bool is_resumed_ = false;
  bool is_due_ = false;  // since the first readable image, or the last one on disk
  bool is_begun_ = false;
  int num_frames_ = 0;
  int num_frames_on_disk_ = 0;  // of a resumed run, before it was resumed
};

}  // namespace msc_vo
