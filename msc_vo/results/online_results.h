// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <utility>

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

/// First line of the trajectory.txt of a run that is still in progress or was killed.
extern const char kUnfinishedTrajectoryComment[];

/// Writes trajectory.txt and frames.csv while a run is in progress, so that they remain if it is
/// killed. Every frame is on disk, as first estimated, when Add() returns; WriteResultFiles
/// replaces both files by the final ones. trajectory.txt contains tracked and weak frames,
/// frames.csv all.
class OnlineResults {
 public:
  /// Creates no file.
  explicit OnlineResults(std::string directory) : directory_(std::move(directory)) {}

  /// The first readable image creates the folder and removes the result files of an earlier run.
  /// Throws std::runtime_error naming the file that cannot be written.
  void Add(const FrameResult& frame);

 private:
  void Begin();

  std::string directory_;
  std::optional<GrowingFile> trajectory_;
  std::optional<GrowingFile> frames_;
  std::string unwritten_rows_;  // unreadable images before the first readable one
};

}  // namespace msc_vo
