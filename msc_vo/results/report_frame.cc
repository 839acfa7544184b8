// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/report_frame.h"

#include <cmath>
#include <optional>

#include "msc_vo/geometry/angles.h"

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

std::optional<CameraSigma> SigmaOf(const Rigid3& pose,
                                   const std::optional<PoseCovariance>& covariance) {
  if (!covariance) return std::nullopt;
  const Eigen::Matrix<double, 6, 1> variance = CameraCovariance(pose, *covariance).diagonal();
  return CameraSigma{RadiansToDegrees(std::sqrt(variance.head<3>().maxCoeff())),
                     std::sqrt(variance.tail<3>().maxCoeff())};
}

}  // namespace

ReportFrame MakeReportFrame(const FrameResult& frame) {
  ReportFrame row;
  row.timestamp = frame.timestamp;
  row.status = ToReportStatus(frame.status);
  row.is_keyframe = frame.is_keyframe;
  row.submap = frame.world;
  row.world_from_cam = frame.cam_from_world.Inverse();
  if (frame.covariance) {
    const Eigen::Matrix<double, 6, 1> variance = frame.covariance->diagonal();
    row.rotation_sigma_deg = RadiansToDegrees(std::sqrt(variance.head<3>().maxCoeff()));
    row.translation_sigma = std::sqrt(variance.tail<3>().maxCoeff());
  }
  row.world_sigma = SigmaOf(frame.cam_from_world, frame.world_covariance);
  row.odometry_sigma = SigmaOf(frame.cam_from_odometry, frame.odometry_covariance);
  row.num_points = frame.num_points;
  row.num_lines = frame.num_lines;
  row.num_inlier_points = frame.num_inlier_points;
  row.num_inlier_lines = frame.num_inlier_lines;
  const StageTimes& times = frame.times;
  row.stage_ms = {times.points,  times.lines,    times.depth, times.features,
                  times.waiting, times.matching, times.pose};
  row.tracking_ms = times.tracking;
  row.mapping_ms = times.mapping;
  return row;
}

std::vector<ReportFrame> ReportFrames(const std::vector<FrameResult>& frames) {
  std::vector<ReportFrame> rows;
  rows.reserve(frames.size());
  for (const FrameResult& frame : frames) rows.push_back(MakeReportFrame(frame));
  return rows;
}

std::vector<ReportStage> ReportStages() {
  return {{"points", false}, {"lines", false}, {"depth", false}, {"features"},
          {"waiting"},       {"matching"},     {"pose"}};
}

}  // namespace msc_vo
