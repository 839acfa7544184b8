// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/run_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "msc_vo/config/options_file.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/report/report.h"
#include "msc_vo/results/calibrated_value.h"
#include "msc_vo/results/report_frame.h"
#include "msc_vo/results/report_paths.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/shell_word.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

std::string StatusText(const RunSummary& summary) {
  std::string text = std::to_string(summary.num_frames) + ":";
  for (size_t i = 0; i < summary.status_counts.size(); ++i) {
    text += FormatText("%s %d %s", i > 0 ? "," : "", summary.status_counts[i],
                       ToString(static_cast<TrackingStatus>(i)));
  }
  return text;
}

// The errors of each segment, aligned by itself.
std::string SegmentErrorText(const std::vector<SegmentError>& errors) {
  std::string text;
  for (const SegmentError& segment : errors) {
    text += FormatText("%ssegment %d: ", text.empty() ? "" : ", ", segment.segment);
    text += segment.error.usable ? FormatText("%.1f mm", 1000.0 * segment.error.ape.rmse)
                                 : "too few poses";
  }
  return text;
}

std::string MapText(const RunSummary& summary) {
  const std::string text = FormatText("%d keyframes, %d points, %d lines", summary.num_keyframes,
                                      summary.num_points, summary.num_lines);
  return summary.num_planes == 0 ? text : text + FormatText(", %d planes", summary.num_planes);
}

std::string AxesText(const RunSummary& summary) {
  if (summary.axes.state == AxesState::kNone) return "none";
  const std::array<int, 3>& lines = summary.num_axis_lines;
  return FormatText("%s, standard deviation %.2f deg; %d + %d + %d lines",
                    ToString(summary.axes.state), RadiansToDegrees(summary.axes.sigma), lines[0],
                    lines[1], lines[2]);
}

// `unit`: what the times are counted per, such as "per frame".
std::string TimeText(const StageTimeStatistics& stage, const char* unit) {
  if (stage.count == 0) return "none";
  return FormatText("%.1f ms %s (median %.1f, 95 %% %.1f, max %.1f)", stage.mean, unit,
                    stage.median, stage.p95, stage.max);
}

std::string TrackingText(const RunSummary& summary) {
  return TimeText(FindStage(summary, "tracking"), "per frame");
}

std::string MappingText(const RunSummary& summary) {
  return TimeText(FindStage(summary, "mapping"), "per keyframe");
}

std::string RealtimeText(const RunSummary& summary, const RealtimeSummary& realtime) {
  return FormatText("paced by the time stamps; %d of %d images dropped, %d maps late; ",
                    summary.Count(TrackingStatus::kDropped), summary.num_frames,
                    realtime.num_late_maps) +
         TimeText(realtime.pose_age, "from image to pose");
}

std::string SpeedText(const RunSummary& summary, const RunCost& cost) {
  const int frames = std::max(summary.num_frames, 1);
  return FormatText(
      "%.1f frames/s including decoding; %.1f s; processor time %.1f ms per frame; "
      "peak memory %.0f MiB",
      summary.num_frames / std::max(cost.seconds, 1e-9), cost.seconds,
      1000.0 * cost.processor_seconds / frames, cost.peak_memory);
}

// The frames with their position errors, in the world of the ground truth if there is one.
std::vector<ReportFrame> AlignedFrames(const OdometryResult& result,
                                       const std::optional<TrajectoryError>& error) {
  std::vector<ReportFrame> frames = ReportFrames(result.frames);
  if (!error || !error->usable) return frames;
  std::map<double, double> errors;  // metres, by time stamp
  for (const PoseError& pose : error->per_pose) errors[pose.timestamp] = pose.translation;
  for (ReportFrame& frame : frames) {
    frame.world_from_cam = error->reference_from_estimate * frame.world_from_cam;
    const auto found = errors.find(frame.timestamp);
    if (found != errors.end()) frame.position_error = found->second;
  }
  return frames;
}

std::string ShutterText(const RunSummary& summary, const RunContext& context) {
  const std::string shutter =
      summary.readout_time == 0.0
          ? "global shutter"
          : FormatText("rolling shutter, readout time %.1f ms", 1000.0 * summary.readout_time);
  return shutter + " (" + context.calibration.readout_origin + ")";
}

std::string DepthSensorText(const RunSummary& summary, const RunContext& context) {
  const DepthSensor given = context.configuration.odometry.features.depth_sensor;
  if (given != DepthSensor::kAuto) return std::string(ToString(given)) + " (given)";
  if (summary.depth_sensor == DepthSensor::kAuto) return "too little depth to tell";
  return std::string(ToString(summary.depth_sensor)) + " (chosen from the depth images)";
}

// Errors against the ground truth, and what is doubtful about it and about the sequence.
std::vector<ReportNumber> ErrorNumbers(const RunContext& context) {
  std::vector<ReportNumber> numbers;
  if (context.error && context.error->usable) {
    const TrajectoryError& error = *context.error;
    numbers.push_back({"APE RMSE", FormatText("%.1f mm", 1000.0 * error.ape.rmse),
                       "position after SE(3) alignment"});
    numbers.push_back({"APE maximum", FormatText("%.1f mm", 1000.0 * error.ape.max), ""});
    numbers.push_back({"Rotation RMSE",
                       FormatText("%.3f deg", RadiansToDegrees(error.rotation.rmse)),
                       "after alignment of the orientations"});
    if (error.rpe_per_second.translation.count > 0) {
      numbers.push_back(
          {"RPE per second",
           FormatText("%.1f mm, %.3f deg", 1000.0 * error.rpe_per_second.translation.rmse,
                      RadiansToDegrees(error.rpe_per_second.rotation.rmse)),
           FormatText("%d pairs", error.rpe_per_second.translation.count)});
    }
    numbers.push_back({"Coverage", FormatText("%.1f %%", 100.0 * error.coverage),
                       "of the reference poses have an estimated pose"});
    for (const std::string& warning : error.warnings) {
      numbers.push_back({TruthName(context.sequence), "doubtful", warning});
    }
  }
  for (const std::string& warning : context.sequence.warnings) {
    numbers.push_back({"Sequence", "doubtful", warning});
  }
  return numbers;
}

std::vector<ReportNumber> MakeNumbers(const RunSummary& summary, const RunContext& context) {
  std::vector<ReportNumber> numbers = ErrorNumbers(context);
  numbers.push_back({"Frames", StatusText(summary), context.outcome});
  if (!context.first_unreadable.empty()) {
    numbers.push_back({"Unreadable images",
                       std::to_string(summary.Count(TrackingStatus::kUnreadable)),
                       "first: " + context.first_unreadable});
  }
  const std::string losses = DescribeLosses(summary);
  if (!losses.empty()) numbers.push_back({"Images without a pose", losses, ""});
  if (summary.segments.size() > 1) {
    numbers.push_back({"Segments", DescribeSegments(summary),
                       "a new one begins when the map cannot be found again"});
  }
  if (!summary.loops.empty()) {
    numbers.push_back({"Loops", DescribeLoops(summary), DescribeLoopFrames(summary)});
  }
  if (summary.has_earlier_sessions) {
    numbers.push_back({"Found", DescribeLocalization(summary),
                       summary.localization ? "the first pose that is measured in that map" : ""});
  }
  if (!context.segment_errors.empty()) {
    numbers.push_back({"APE RMSE of segments", SegmentErrorText(context.segment_errors),
                       "each aligned by itself"});
  }
  numbers.push_back({"Map", MapText(summary), "at the end of the run"});
  numbers.push_back({"Manhattan axes", AxesText(summary), ""});
  numbers.push_back({"Tracking", TrackingText(summary), ""});
  numbers.push_back({"Mapping", MappingText(summary), ""});
  if (context.realtime) {
    numbers.push_back({"Real time", RealtimeText(summary, *context.realtime), ""});
  }
  numbers.push_back({"Speed", SpeedText(summary, context.cost), ""});
  numbers.push_back({"Camera", context.calibration.origin, ""});
  numbers.push_back({"Shutter", ShutterText(summary, context), ""});
  numbers.push_back({"Depth sensor", DepthSensorText(summary, context), ""});
  return numbers;
}

// "481.30 +- 1.70 px".
std::string ValueText(const CalibratedValue& value) {
  const int digits = *value.unit != '\0' ? 2 : 4;
  std::string text = FormatText("%.*f", digits, value.value);
  if (std::isfinite(value.sigma)) text += FormatText(" +- %.*f", digits, value.sigma);
  if (*value.unit != '\0') text += std::string(" ") + value.unit;
  return text;
}

std::vector<ReportNumber> SelfCalibration(const RunSummary& summary, const RunContext& context) {
  const NoiseScale& scale = summary.noise_scale;
  const auto factor = [](double value) { return FormatText("x %.2f", value); };
  std::vector<ReportNumber> numbers = {
      {"Noise of point depth", factor(scale.point_depth), "factor of the sigmas of the features"},
      {"Noise of line pixels", factor(scale.line_pixel), ""},
      {"Noise of line depth", factor(scale.line_depth), ""},
      {"Readout time", FormatText("%.1f ms", 1000.0 * summary.readout_time),
       context.calibration.readout_origin}};
  for (const CalibratedValue& value : ListCalibratedValues(summary)) {
    numbers.push_back({value.name, ValueText(value), value.verdict});
  }
  if (summary.axes.state != AxesState::kNone) {
    numbers.push_back({"Manhattan axes",
                       FormatText("sigma %.2f deg", RadiansToDegrees(summary.axes.sigma)),
                       FormatText("%d refinements", summary.axes.num_refinements)});
  }
  return numbers;
}

// The final map, moved by `to_from_world`.
ReportMap FinalMap(const OdometryResult& result, const Rigid3& to_from_world) {
  ReportMap map;
  for (const MapLine& line : result.lines) {
    map.lines.push_back({{to_from_world * line.segment.start, to_from_world * line.segment.end},
                         line.axis.value_or(-1)});
  }
  for (const MapPoint& point : result.points) map.points.push_back(to_from_world * point.position);
  for (const MapPlane& plane : result.planes) {
    map.planes.push_back({to_from_world * plane.extent, plane.axis.value_or(-1)});
  }
  if (result.axes.state != AxesState::kNone) {
    map.world_from_axes = to_from_world.rotation() * result.axes.world_from_axes;
  }
  return map;
}

// Adds the views with indices of frames in place of their ids.
void AddViews(const std::vector<FrameResult>& frames, const RunContext& context, ReportData* data) {
  std::map<int64_t, int> indices;
  for (size_t i = 0; i < frames.size(); ++i) indices[frames[i].id] = static_cast<int>(i);
  data->views = context.views;
  for (FrameView& view : data->views) view.frame = indices.at(view.frame);
  data->place = context.place;
  if (data->place) data->place->frame = indices.at(data->place->frame);
}

std::string Row(const char* name, const std::string& text) {
  return FormatText("%-10s ", name) + text + "\n";
}

// Explanation after the numbers of a stage.
const char* StageNote(const std::string& name) {
  if (name == "tracking") return "  per frame";
  if (name == "mapping") return "  per keyframe";
  for (const ReportStage& stage : ReportStages()) {
    if (stage.name == name && !stage.is_stacked) return "  part of features, in parallel";
  }
  return "";
}

std::string StageRows(const std::vector<StageTimeStatistics>& stages) {
  std::string rows = Row("time, ms", "               mean  median    95 %     max");
  for (const StageTimeStatistics& stage : stages) {
    rows += Row("", FormatText("%-11s %7.1f %7.1f %7.1f %7.1f%s", stage.name.c_str(), stage.mean,
                               stage.median, stage.p95, stage.max, StageNote(stage.name)));
  }
  return rows;
}

std::string ErrorRows(const TrajectoryError& error) {
  if (!error.usable) return Row("error", "not available: " + error.message);
  std::string rows =
      Row("error", FormatText("APE RMSE %.1f mm (median %.1f, max %.1f), rotation %.2f deg",
                              1000.0 * error.ape.rmse, 1000.0 * error.ape.median,
                              1000.0 * error.ape.max, RadiansToDegrees(error.rotation.rmse)));
  const RelativeError& second = error.rpe_per_second;
  if (second.translation.count > 0) {
    rows += Row("", FormatText("RPE %.1f mm/s, %.2f deg/s", 1000.0 * second.translation.rmse,
                               RadiansToDegrees(second.rotation.rmse)));
  }
  return rows + Row("", FormatText("%.1f %% of the reference poses have an estimated pose",
                                   100.0 * error.coverage));
}

// What self-calibration has corrected, and how to keep it; empty if nothing.
std::string CorrectionRows(const RunSummary& summary, const RunContext& context) {
  if (!summary.calibration.IsCorrected()) return "";
  std::string corrected;
  for (const CalibratedValue& value : ListCalibratedValues(summary)) {
    if (!value.is_corrected) continue;
    corrected += (corrected.empty() ? "" : ", ") + std::string(value.name) + " " + ValueText(value);
  }
  return Row("corrected", corrected) +
         Row("", "determine it once with msc_vo calibrate " +
                     ShellWord(context.sequence.directory) + " --output camera.yaml");
}

}  // namespace

std::string FormatRunTable(const RunSummary& summary, const RunContext& context,
                           const std::string& output_directory) {
  std::string table =
      Row("sequence", context.sequence.directory + " (" + context.sequence.format + ", " +
                          std::to_string(context.sequence.entries.size()) + " images)");
  table += Row("camera", context.calibration.origin);
  table += Row("", ShutterText(summary, context));
  table += CorrectionRows(summary, context);
  table += Row("depth", DepthSensorText(summary, context));
  table += Row("frames", StatusText(summary));
  for (const NotTrackedSpan& span : summary.not_tracked) {
    table += Row("", FormatText("no pose in frames %d to %d", span.first_frame, span.last_frame));
  }
  const std::string losses = DescribeLosses(summary);
  if (!losses.empty()) table += Row("", "images without a pose: " + losses);
  if (summary.segments.size() > 1) table += Row("segments", DescribeSegments(summary));
  if (!summary.loops.empty()) table += Row("loops", DescribeLoops(summary));
  if (summary.has_earlier_sessions) table += Row("found", DescribeLocalization(summary));
  table += Row("map", MapText(summary));
  table += Row("axes", AxesText(summary));
  table += StageRows(summary.stages);
  if (context.realtime) table += Row("real time", RealtimeText(summary, *context.realtime));
  table += Row("speed", SpeedText(summary, context.cost));
  if (context.error) table += ErrorRows(*context.error);
  if (!context.segment_errors.empty()) {
    table += Row("", "APE RMSE of each segment: " + SegmentErrorText(context.segment_errors));
  }
  table += Row("output", output_directory + " (report.html, trajectory.txt, summary.json, ...)");
  if (context.error && context.error->usable) {
    const std::filesystem::path output = output_directory;
    table +=
        Row("check with",
            "evo_ape tum " + ShellWord((output / TruthFileName(context.sequence)).string()) + " " +
                ShellWord((output / "trajectory.txt").string()) + " -a --t_max_diff 0.02");
    if (summary.num_estimated < summary.num_frames) {
      table += Row("",
                   "(evo_ape compares all poses, like msc_vo evaluate --all-poses; the errors "
                   "above are those of the estimated poses)");
    }
  }
  return table;
}

std::string FormatReport(const OdometryResult& result, const RunSummary& summary,
                         const RunContext& context) {
  ReportData data;
  Rigid3 ground_truth_from_world;
  if (context.error && context.error->usable) {
    ground_truth_from_world = context.error->reference_from_estimate;
    data.truth_name = TruthName(context.sequence);
    for (const TimedPose& pose : context.sequence.ground_truth) {
      data.ground_truth.push_back({pose.timestamp, pose.world_from_cam.translation()});
    }
  }
  data.title = context.sequence_name;
  data.version = std::string("msc_vo ") + kVersion;
  data.command_line = context.command_line;
  data.options_text =
      FormatConfiguration(EffectiveConfiguration(context.configuration), OptionSelection::kAll);
  data.numbers = MakeNumbers(summary, context);
  data.stages = ReportStages();
  data.frames = AlignedFrames(result, context.error);
  data.self_calibration = SelfCalibration(summary, context);
  for (const Loop& loop : result.loops) data.loops.push_back({loop.frame, loop.reference});
  if (!result.loops.empty()) data.odometry = OdometryPath(result.frames, ground_truth_from_world);
  if (summary.localization) data.found_frame = summary.localization->frame;
  data.map = FinalMap(result, ground_truth_from_world);
  data.map.sessions = EarlierSessions(result, ground_truth_from_world);
  AddViews(result.frames, context, &data);
  data.camera = context.calibration.camera;
  data.up_in_cam.y() = context.calibration.camera.fy < 0.0 ? 1.0 : -1.0;
  std::ostringstream page;
  WriteReport(data, page);
  return page.str();
}

}  // namespace msc_vo
