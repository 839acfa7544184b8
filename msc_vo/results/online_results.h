// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

/// First line of the trajectory.txt of a run that goes on or was killed.
extern const char kUnfinishedTrajectoryComment[];

/// trajectory.txt and frames.csv while a run goes on: every frame as it was first estimated, on
/// disk as soon as it is known, so that a run that is killed leaves them. WriteResultFiles replaces
/// both by the final ones. trajectory.txt has the tracked and weak frames, frames.csv all.
class OnlineResults {
 public:
  // Writes nothing yet.
  explicit OnlineResults(std::string directory) : directory_(std::move(directory)) {}

  /// The first frame whose image could be read makes the folder and removes what a finished run
  /// would replace: no summary of an earlier run stands beside the trajectory of this one. Throws
  /// std::runtime_error naming the file that cannot be written.
  void Add(const FrameResult& frame);

 private:
  void Begin();

  std::string directory_;
  std::optional<GrowingFile> trajectory_;
  std::optional<GrowingFile> frames_;
  std::string unwritten_rows_;  // of images that could not be read, before the first that could
};

}  // namespace msc_vo
