// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/online_results.h"

#include <filesystem>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/results/result_files.h"

namespace msc_vo {

const char kUnfinishedTrajectoryComment[] =
    "# unfinished run of msc_vo: poses as first estimated, without later corrections\n";

void OnlineResults::Begin() {
  MakeFolder(directory_);
  RemoveResultFiles(directory_);
  const std::filesystem::path folder = directory_;
  trajectory_.emplace((folder / "trajectory.txt").string());
  trajectory_->Append(kUnfinishedTrajectoryComment);
  frames_.emplace((folder / "frames.csv").string());
  frames_->Append(FormatFramesCsv({}));
}

void OnlineResults::Add(const FrameResult& frame) {
  unwritten_rows_ += FormatFrameRow(frame);
  if (!trajectory_) {
    if (frame.status == TrackingStatus::kUnreadable) return;
    Begin();
  }
  if (frame.status == TrackingStatus::kTracked || frame.status == TrackingStatus::kWeak) {
    trajectory_->Append(FormatTrajectory({{frame.timestamp, frame.cam_from_world.Inverse()}}));
  }
  frames_->Append(unwritten_rows_);
  unwritten_rows_.clear();
}

}  // namespace msc_vo
