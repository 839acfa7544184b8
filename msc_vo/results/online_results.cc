// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/online_results.h"

#include <algorithm>
#include <filesystem>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/results/result_files.h"

namespace msc_vo {

const char kUnfinishedTrajectoryComment[] =
    "# unfinished run of msc_vo: poses as first estimated, without later corrections\n";

namespace {

// Rows of the frames.csv that an unfinished run has left; 0 if there is none.
int CountFrames(const std::string& trajectory, const std::string& frames) {
  if (!FileProblem(trajectory).empty() || !FileProblem(frames).empty()) return 0;
  if (ReadFile(trajectory).rfind(kUnfinishedTrajectoryComment, 0) != 0) return 0;
  const std::string rows = ReadFile(frames);
  const auto num_lines = std::count(rows.begin(), rows.end(), '\n');
  return std::max(0, static_cast<int>(num_lines) - 1);
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
    if (!is_resumed_) RemoveResultFiles(directory_);
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
  num_frames_on_disk_ =
      CountFrames((folder / "trajectory.txt").string(), (folder / "frames.csv").string());
  for (const FrameResult& frame : frames) AddUnwritten(frame);
}

void OnlineResults::AddUnwritten(const FrameResult& frame) {
  ++num_frames_;
  unwritten_rows_ += FormatFrameRow(frame);
  if (frame.status == TrackingStatus::kTracked || frame.status == TrackingStatus::kWeak) {
    unwritten_poses_ += FormatTrajectory({{frame.timestamp, frame.cam_from_world.Inverse()}});
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
