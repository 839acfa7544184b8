// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/run_report.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>

#include "msc_vo/io/options_file.h"
#include "msc_vo/version.h"
#include "msc_vo/viewer/report.h"

namespace msc_vo {

namespace {

// printf into a string.
template <typename... Values>
std::string Format(const char* format, Values... values) {
  std::string text(static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

double Degrees(double radians) { return radians * 180.0 / std::acos(-1.0); }

const StageStatistics* FindStage(const RunSummary& summary, const std::string& name) {
  for (const StageStatistics& stage : summary.stages) {
    if (stage.name == name && stage.count > 0) return &stage;
  }
  return nullptr;
}

std::string StatusText(const RunSummary& summary) {
  std::string text = std::to_string(summary.num_frames) + ":";
  for (size_t i = 0; i < summary.status_counts.size(); ++i) {
    text += Format("%s %d %s", i > 0 ? "," : "", summary.status_counts[i],
                   ToString(static_cast<TrackingStatus>(i)));
  }
  return text;
}

std::string MapText(const RunSummary& summary) {
  return Format("%d keyframes, %d points, %d lines", summary.num_keyframes, summary.num_points,
                summary.num_lines);
}

std::string TrackingText(const RunSummary& summary) {
  const StageStatistics* tracking = FindStage(summary, "tracking");
  return tracking ? Format("%.1f ms per frame (median %.1f, 95 %% %.1f, max %.1f)", tracking->mean,
                           tracking->median, tracking->p95, tracking->max)
                  : "none";
}

std::string MappingText(const RunSummary& summary) {
  const StageStatistics* mapping = FindStage(summary, "mapping");
  return mapping ? Format("%.1f ms per keyframe (median %.1f, 95 %% %.1f, max %.1f)", mapping->mean,
                          mapping->median, mapping->p95, mapping->max)
                 : "none";
}

std::string SpeedText(const RunSummary& summary, const RunContext& context) {
  return Format("%.1f frames/s, reading the images included; %.1f s; %.0f MiB at most",
                summary.num_frames / std::max(context.seconds, 1e-9), context.seconds,
                context.peak_memory);
}

ReportStatus ToReportStatus(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kTracked:
      return ReportStatus::kTracked;
    case TrackingStatus::kWeak:
      return ReportStatus::kWeak;
    case TrackingStatus::kPredicted:
      return ReportStatus::kPredicted;
    case TrackingStatus::kLost:
      break;
  }
  return ReportStatus::kLost;
}

std::vector<ReportFrame> MakeFrames(const OdometryResult& result, const Rigid3& truth_from_world,
                                    const std::map<double, double>& errors) {
  std::vector<ReportFrame> frames;
  for (const FrameResult& frame : result.frames) {
    ReportFrame row;
    row.timestamp = frame.timestamp;
    row.status = ToReportStatus(frame.status);
    row.is_keyframe = frame.is_keyframe;
    row.world_from_cam = truth_from_world * frame.cam_from_world.Inverse();
    const auto error = errors.find(frame.timestamp);
    if (error != errors.end()) row.position_error = error->second;
    row.num_points = frame.num_points;
    row.num_lines = frame.num_lines;
    row.num_inlier_points = frame.num_inlier_points;
    row.num_inlier_lines = frame.num_inlier_lines;
    const StageTimes& times = frame.times;
    row.stage_ms = {times.points, times.lines, times.depth, times.matching, times.pose};
    row.tracking_ms = times.tracking;
    row.mapping_ms = times.mapping;
    frames.push_back(std::move(row));
  }
  return frames;
}

std::vector<ReportNumber> MakeNumbers(const RunSummary& summary, const RunContext& context) {
  std::vector<ReportNumber> numbers;
  if (context.error && context.error->usable) {
    const TrajectoryError& error = *context.error;
    numbers.push_back({"APE RMSE", Format("%.1f mm", 1000.0 * error.ape.rmse),
                       "position, after SE(3) alignment"});
    numbers.push_back({"APE maximum", Format("%.1f mm", 1000.0 * error.ape.max), ""});
    numbers.push_back({"APE rotation", Format("%.3f deg", Degrees(error.ape_rotation.rmse)), ""});
    if (error.rpe_per_second.translation.count > 0) {
      numbers.push_back({"RPE per second",
                         Format("%.1f mm, %.3f deg", 1000.0 * error.rpe_per_second.translation.rmse,
                                Degrees(error.rpe_per_second.rotation.rmse)),
                         Format("%d pairs", error.rpe_per_second.translation.count)});
    }
    numbers.push_back({"Coverage", Format("%.1f %%", 100.0 * error.coverage),
                       "ground-truth poses with an estimate"});
  }
  numbers.push_back({"Frames", StatusText(summary), context.outcome});
  numbers.push_back({"Map", MapText(summary), "at the end"});
  numbers.push_back({"Tracking", TrackingText(summary), ""});
  numbers.push_back({"Mapping", MappingText(summary), ""});
  numbers.push_back({"Speed", SpeedText(summary, context), ""});
  numbers.push_back({"Camera", context.calibration.origin, ""});
  return numbers;
}

void PrintRow(const char* name, const std::string& text) {
  std::printf("%-10s %s\n", name, text.c_str());
}

void PrintError(const TrajectoryError& error) {
  if (!error.usable) {
    PrintRow("error", "unknown: " + error.message);
    return;
  }
  PrintRow("error", Format("APE RMSE %.1f mm (median %.1f, max %.1f), rotation %.2f deg",
                           1000.0 * error.ape.rmse, 1000.0 * error.ape.median,
                           1000.0 * error.ape.max, Degrees(error.ape_rotation.rmse)));
  if (error.rpe_per_second.translation.count > 0) {
    PrintRow("", Format("RPE %.1f mm/s, %.2f deg/s", 1000.0 * error.rpe_per_second.translation.rmse,
                        Degrees(error.rpe_per_second.rotation.rmse)));
  }
  PrintRow("",
           Format("%.1f %% of the ground-truth poses have an estimate", 100.0 * error.coverage));
}

}  // namespace

void PrintRunTable(const RunSummary& summary, const RunContext& context,
                   const std::string& output_directory) {
  const std::filesystem::path output = output_directory;
  PrintRow("sequence", context.sequence.directory + " (" + context.sequence.format + ", " +
                           std::to_string(context.sequence.entries.size()) + " images)");
  PrintRow("camera", context.calibration.origin);
  PrintRow("frames", StatusText(summary));
  for (const UntrackedSpan& span : summary.untracked) {
    PrintRow("", Format("no pose in frames %d to %d", span.first, span.last));
  }
  PrintRow("map", MapText(summary));
  PrintRow("tracking", TrackingText(summary));
  PrintRow("mapping", MappingText(summary));
  PrintRow("speed", SpeedText(summary, context));
  if (context.error) PrintError(*context.error);
  PrintRow("output", output.string() + " (report.html, trajectory.txt, summary.json, ...)");
  if (context.error && context.error->usable) {
    PrintRow("check with", "evo_ape tum " + (output / "groundtruth.txt").string() + " " +
                               (output / "trajectory.txt").string() + " -a --t_max_diff 0.02");
  }
  std::fflush(stdout);
}

std::string FormatReport(const OdometryResult& result, const RunSummary& summary,
                         const RunContext& context) {
  ReportData data;
  Rigid3 truth_from_world;
  std::map<double, double> errors;  // metres, by time stamp
  if (context.error && context.error->usable) {
    truth_from_world = context.error->reference_from_estimate;
    for (const PoseError& pose : context.error->per_pose) {
      errors[pose.timestamp] = pose.translation;
    }
    for (const TimedPose& pose : context.sequence.ground_truth) {
      data.truth.push_back({pose.timestamp, pose.world_from_cam.translation()});
    }
  }
  data.title = std::filesystem::path(context.sequence.directory).filename().string();
  data.version = std::string("msc_vo ") + kVersion;
  data.command_line = context.command_line;
  data.options_text = FormatConfiguration(context.configuration);
  data.numbers = MakeNumbers(summary, context);
  data.stage_names = {"points", "lines", "depth", "matching", "pose"};
  data.frames = MakeFrames(result, truth_from_world, errors);
  for (const MapLine& line : result.lines) {
    data.lines.push_back(
        {{truth_from_world * line.segment.start, truth_from_world * line.segment.end}});
  }
  data.up_in_cam.y() = context.calibration.camera.fy < 0.0 ? 1.0 : -1.0;
  std::ostringstream page;
  WriteReport(data, page);
  return page.str();
}

}  // namespace msc_vo
