// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/report_frame.h"

#include <utility>

namespace msc_vo {

namespace {

ReportStatus ToReportStatus(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kTracked:
      return ReportStatus::kTracked;
    case TrackingStatus::kWeak:
      return ReportStatus::kWeak;
    case TrackingStatus::kPredicted:
      return ReportStatus::kPredicted;
    case TrackingStatus::kDropped:
      return ReportStatus::kDropped;
    case TrackingStatus::kUnreadable:
      return ReportStatus::kUnreadable;
    case TrackingStatus::kLost:
      break;
  }
  return ReportStatus::kLost;
}

}  // namespace

std::vector<ReportFrame> ReportFrames(const std::vector<FrameResult>& frames) {
  std::vector<ReportFrame> rows;
  for (const FrameResult& frame : frames) {
    ReportFrame row;
    row.timestamp = frame.timestamp;
    row.status = ToReportStatus(frame.status);
    row.is_keyframe = frame.is_keyframe;
    row.world_from_cam = frame.cam_from_world.Inverse();
    row.num_points = frame.num_points;
    row.num_lines = frame.num_lines;
    row.num_inlier_points = frame.num_inlier_points;
    row.num_inlier_lines = frame.num_inlier_lines;
    const StageTimes& times = frame.times;
    row.stage_ms = {times.points,  times.lines,    times.depth, times.features,
                    times.waiting, times.matching, times.pose};
    row.tracking_ms = times.tracking;
    row.mapping_ms = times.mapping;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ReportStage> ReportStages() {
  return {{"points", false}, {"lines", false}, {"depth", false}, {"features"},
          {"waiting"},       {"matching"},     {"pose"}};
}

}  // namespace msc_vo
