// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/online_results.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/results/result_files.h"

namespace msc_vo {

const char kUnfinishedTrajectoryComment[] =
    "# unfinished run of msc_vo: poses as first estimated, without later corrections\n";

namespace {

// Rows of the frames.csv that a run has left: unfinished, or killed while it wrote its final
// results; 0 if there is none.
int CountFrames(const std::string& path) {
  if (!FileProblem(path).empty()) return 0;
  const std::string rows = ReadFile(path), header = FormatFramesCsv({});
  if (rows.rfind(header, 0) != 0) return 0;
  return static_cast<int>(
      std::count(rows.begin() + static_cast<std::ptrdiff_t>(header.size()), rows.end(), '\n'));
}

// Appends `text` to a file that begins with `header`, and empties it.
void AppendTo(const std::string& path, const std::string& header, std::optional<GrowingFile>* file,
              std::string* text) {
  if (!*file) {
    file->emplace(path, header + *text);
  } else if (!text->empty()) {
    (*file)->Append(*text);
  }
  text->clear();
}

}  // namespace

void OnlineResults::Write() {
  if (!is_begun_) {
    MakeFolder(directory_);
    if (!is_resumed_) RemoveResultFiles(directory_, sequence_);
    WriteIdentity(directory_, sequence_);
    is_begun_ = true;
  }
  const std::filesystem::path folder = directory_;
  // In this order, so that a run that is killed leaves no pose without its row.
  AppendTo((folder / "frames.csv").string(), FormatFramesCsv({}), &frames_, &unwritten_rows_);
  AppendTo((folder / "trajectory.txt").string(), kUnfinishedTrajectoryComment, &trajectory_,
           &unwritten_poses_);
}

void OnlineResults::Continue(const std::vector<FrameResult>& frames) {
  const std::filesystem::path folder = directory_;
  is_resumed_ = true;
  num_frames_on_disk_ = CountFrames((folder / "frames.csv").string());
  for (const FrameResult& frame : frames) AddUnwritten(frame);
}

void OnlineResults::AddUnwritten(const FrameResult& frame) {
  ++num_frames_;
  unwritten_rows_ += FormatFrameRow(frame);
  if (frame.status == TrackingStatus::kTracked || frame.status == TrackingStatus::kWeak) {
    const TimedPose pose = {frame.timestamp, frame.cam_from_world.Inverse(), true, frame.segment,
                            frame.world};
    unwritten_poses_ += FormatTrajectory({pose}, last_pose_);
    last_pose_ = pose;
  }
}

void OnlineResults::Add(const FrameResult& frame) {
  AddUnwritten(frame);
  const bool is_first = is_resumed_ ? num_frames_ >= num_frames_on_disk_
                                    : frame.status != TrackingStatus::kUnreadable;
  is_due_ = is_due_ || is_first;
  if (is_due_) Write();
}

}  // namespace msc_vo
