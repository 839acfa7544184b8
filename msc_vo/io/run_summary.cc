// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/io/run_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace msc_vo {

namespace {

bool IsTracked(const FrameResult& frame) {
  return frame.status == TrackingStatus::kTracked || frame.status == TrackingStatus::kWeak;
}

StageStatistics StatisticsOf(const std::string& name, std::vector<double> milliseconds) {
  StageStatistics statistics;
  statistics.name = name;
  statistics.count = static_cast<int>(milliseconds.size());
  if (milliseconds.empty()) return statistics;
  std::sort(milliseconds.begin(), milliseconds.end());
  // The smallest sample that at least the share p of all samples do not exceed.
  const auto quantile = [&](double p) {
    const double rank = std::ceil(p * static_cast<double>(milliseconds.size()));
    return milliseconds[static_cast<size_t>(std::max(rank, 1.0)) - 1];
  };
  statistics.mean = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0) /
                    static_cast<double>(milliseconds.size());
  statistics.median = quantile(0.5);
  statistics.p95 = quantile(0.95);
  statistics.max = milliseconds.back();
  return statistics;
}

std::vector<StageStatistics> StagesOf(const std::vector<FrameResult>& frames) {
  struct Stage {
    const char* name;
    double StageTimes::*milliseconds;
  };
  constexpr Stage kStages[] = {
      {"points", &StageTimes::points},  {"lines", &StageTimes::lines},
      {"depth", &StageTimes::depth},    {"matching", &StageTimes::matching},
      {"pose", &StageTimes::pose},      {"tracking", &StageTimes::tracking},
      {"mapping", &StageTimes::mapping}};
  std::vector<StageStatistics> stages;
  for (const Stage& stage : kStages) {
    std::vector<double> milliseconds;
    for (const FrameResult& frame : frames) {
      const bool is_mapping = stage.milliseconds == &StageTimes::mapping;
      if (is_mapping && frame.times.mapping == 0.0) continue;
      milliseconds.push_back(frame.times.*stage.milliseconds);
    }
    stages.push_back(StatisticsOf(stage.name, std::move(milliseconds)));
  }
  return stages;
}

}  // namespace

RunSummary Summarize(const OdometryResult& result) {
  RunSummary summary;
  summary.num_frames = static_cast<int>(result.frames.size());
  bool in_gap = false;
  for (int i = 0; i < summary.num_frames; ++i) {
    const FrameResult& frame = result.frames[i];
    ++summary.status_counts.at(static_cast<size_t>(frame.status));
    if (!IsTracked(frame)) {
      if (!in_gap) summary.untracked.push_back({i, i, frame.timestamp, frame.timestamp});
      summary.untracked.back().last = i;
      summary.untracked.back().end = frame.timestamp;
    }
    in_gap = !IsTracked(frame);
  }
  const auto tracked = std::count_if(result.frames.begin(), result.frames.end(), IsTracked);
  summary.tracked_share = static_cast<double>(tracked) / std::max(summary.num_frames, 1);
  summary.stages = StagesOf(result.frames);
  summary.num_keyframes = static_cast<int>(result.keyframes.size());
  summary.num_points = static_cast<int>(result.points.size());
  summary.num_lines = static_cast<int>(result.lines.size());
  return summary;
}

std::vector<TimedPose> TrajectoryOf(const OdometryResult& result) {
  std::vector<TimedPose> poses;
  for (const FrameResult& frame : result.frames) {
    poses.push_back({frame.timestamp, frame.cam_from_world.Inverse()});
  }
  return poses;
}

}  // namespace msc_vo
