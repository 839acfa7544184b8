// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// JSON of a comparison, a run and a benchmark.

#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/benchmark.h"
#include "msc_vo/results/run_summary.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;

// The number, or null where there were no samples.
Json NumberIf(int count, double value) { return count > 0 ? Json(value) : Json(); }

Json ErrorToJson(const TrajectoryError& error) {
  const RelativeError& second = error.rpe_per_second;
  const RelativeError& metre = error.rpe_per_metre;
  Json json;
  json["usable"] = error.usable;
  if (!error.usable) json["message"] = error.message;
  json["ape_rmse"] = NumberIf(error.ape.count, error.ape.rmse);
  json["ape_mean"] = NumberIf(error.ape.count, error.ape.mean);
  json["ape_median"] = NumberIf(error.ape.count, error.ape.median);
  json["ape_max"] = NumberIf(error.ape.count, error.ape.max);
  json["rotation_deg"] = NumberIf(error.rotation.count, RadiansToDegrees(error.rotation.rmse));
  json["ape_rot_deg"] = NumberIf(error.ape.count, RadiansToDegrees(error.ape_rotation.rmse));
  json["rpe_1s"] = NumberIf(second.translation.count, second.translation.rmse);
  json["rpe_1s_rot_deg"] = NumberIf(second.rotation.count, RadiansToDegrees(second.rotation.rmse));
  json["rpe_pairs"] = second.translation.count;
  json["rpe_1m"] = NumberIf(metre.translation.count, metre.translation.rmse);
  json["rpe_1m_rot_deg"] = NumberIf(metre.rotation.count, RadiansToDegrees(metre.rotation.rmse));
  json["rpe_1m_pairs"] = metre.translation.count;
  json["matched"] = error.num_matched;
  json["est"] = error.num_estimate;
  json["not_estimated"] = error.num_not_estimated;
  json["gt"] = error.num_reference;
  json["gt_in_range"] = error.num_reference_in_range;
  json["coverage"] = error.coverage;
  json["coverage_in_range"] = error.coverage_in_range;
  json["path_len"] = error.path_length;
  return json;
}

Json StatisticsToJson(const ErrorStatistics& statistics, double factor = 1.0) {
  return {{"rmse", NumberIf(statistics.count, factor * statistics.rmse)},
          {"mean", NumberIf(statistics.count, factor * statistics.mean)},
          {"median", NumberIf(statistics.count, factor * statistics.median)},
          {"p95", NumberIf(statistics.count, factor * statistics.p95)},
          {"max", NumberIf(statistics.count, factor * statistics.max)}};
}

Json LineErrorToJson(const LineError& error) {
  return {{"count", error.num_lines},
          {"counted", error.num_counted},
          {"matched", error.num_matched},
          {"edges", error.num_edges},
          {"edges_found", error.num_edges_found},
          {"direction_deg", StatisticsToJson(error.direction, RadiansToDegrees(1.0))},
          {"distance", StatisticsToJson(error.distance)},
          {"distance_across", StatisticsToJson(error.across)}};
}

Json CameraToJson(const Calibration& calibration) {
  const PinholeCamera& camera = calibration.camera;
  return {{"origin", calibration.origin},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"width", camera.width},
          {"height", camera.height},
          {"depth_scale", calibration.depth_scale},
          {"distortion", calibration.distortion.k}};
}

// The options in effect, flat: {"tracking.wide_radius": 60.0}.
Json OptionsToJson(const Configuration& configuration) {
  OdometryOptions effective = EffectiveOptions(configuration.odometry);
  Json json = Json::object();
  for (const Option& option : ListOptions(&effective)) {
    std::visit(
        [&](const auto& value) {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, bool*> || std::is_same_v<Value, int*> ||
                        std::is_same_v<Value, double*>) {
            json[option.path] = *value;
          } else {
            json[option.path] = FormatOption(option);
          }
        },
        option.value);
  }
  return json;
}

Json StatisticsToJson(const StageTimeStatistics& stage) {
  return {{"count", stage.count},
          {"mean", stage.mean},
          {"median", stage.median},
          {"p95", stage.p95},
          {"max", stage.max}};
}

Json StagesToJson(const std::vector<StageTimeStatistics>& stages) {
  Json json = Json::object();
  for (const StageTimeStatistics& stage : stages) {
    json[stage.name] = StatisticsToJson(stage);
  }
  return json;
}

// Null if the sequence was replayed as fast as possible.
Json RealtimeToJson(const std::optional<RealtimeSummary>& realtime) {
  if (!realtime) return {};
  return {{"late_maps", realtime->num_late_maps},
          {"pose_age_ms", StatisticsToJson(realtime->pose_age)}};
}

Json FramesToJson(const RunSummary& summary) {
  Json json = {{"count", summary.num_frames}};
  for (size_t i = 0; i < summary.status_counts.size(); ++i) {
    json[ToString(static_cast<TrackingStatus>(i))] = summary.status_counts[i];
  }
  json["tracked_share"] = summary.tracked_share;
  json["loss_causes"] = Json::object();
  for (size_t i = 0; i < summary.loss_causes.size(); ++i) {
    json["loss_causes"][ToString(static_cast<LossCause>(i))] = summary.loss_causes[i];
  }
  json["with_motion"] = summary.num_frames_with_motion;
  json["not_tracked_spans"] = Json::array();
  for (const NotTrackedSpan& span : summary.not_tracked) {
    json["not_tracked_spans"].push_back({{"first_frame", span.first_frame},
                                         {"last_frame", span.last_frame},
                                         {"start", span.start},
                                         {"end", span.end}});
  }
  return json;
}

Json AxesToJson(const RunSummary& summary) {
  const MapAxes& axes = summary.axes;
  Json json = {{"state", ToString(axes.state)}};
  if (axes.state == AxesState::kNone) return json;
  const Eigen::Vector4d q = axes.world_from_axes.coeffs();
  json["frozen"] = axes.frozen;
  json["refinements"] = axes.num_refinements;
  json["sigma_deg"] = RadiansToDegrees(axes.sigma);
  json["world_from_axes"] = {q.x(), q.y(), q.z(), q.w()};
  json["lines"] = summary.num_axis_lines;
  return json;
}

Json NoiseToJson(const NoiseScale& scale) {
  return {{"point_depth", scale.point_depth},
          {"line_pixel", scale.line_pixel},
          {"line_depth", scale.line_depth}};
}

Json WindowToJson(const BundleAdjustmentSummary& window) {
  const std::pair<const char*, const TermSummary*> terms[] = {
      {"point_reprojection", &window.point_reprojection},
      {"point_depth", &window.point_depth},
      {"line_reprojection", &window.line_reprojection},
      {"line_depth", &window.line_depth},
      {"line_endpoint_prior", &window.line_endpoint_prior},
      {"parallel", &window.parallel},
      {"perpendicular", &window.perpendicular},
      {"manhattan", &window.manhattan}};
  Json json = {{"usable", window.usable}, {"iterations", window.num_iterations}};
  for (const auto& [name, term] : terms) {
    json[name] = {{"blocks", term->num_residual_blocks},
                  {"rejected", term->num_rejected},
                  {"initial_cost", term->initial_cost},
                  {"final_cost", term->final_cost}};
  }
  return json;
}

// What was measured of a run.
Json MeasuresToJson(const RunSummary& summary, const std::optional<TrajectoryError>& error,
                    const RunCost& cost) {
  Json json;
  json["frames"] = FramesToJson(summary);
  json["map"] = {{"keyframes", summary.num_keyframes},
                 {"points", summary.num_points},
                 {"lines", summary.num_lines}};
  json["manhattan_axes"] = AxesToJson(summary);
  json["noise_scale"] = NoiseToJson(summary.noise_scale);
  json["readout_time"] = summary.readout_time;
  json["last_window"] = WindowToJson(summary.last_window);
  json["error"] = error ? ErrorToJson(*error) : Json();
  json["stages_ms"] = StagesToJson(summary.stages);
  json["wall_seconds"] = cost.seconds;
  json["frames_per_second"] = NumberIf(cost.seconds > 0.0, summary.num_frames / cost.seconds);
  json["processor_seconds"] = cost.processor_seconds;
  json["peak_memory_mib"] = cost.peak_memory;
  return json;
}

// Texts from the outside (paths, messages) need not be UTF-8.
std::string Dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string FormatErrorJson(const TrajectoryError& error, const LeftOutRows& left_out,
                            const std::optional<LineError>& lines) {
  Json json = ErrorToJson(error);
  json["est_left_out"] = left_out.estimate;
  json["gt_left_out"] = left_out.reference;
  if (lines) json["lines"] = LineErrorToJson(*lines);
  return Dump(json);
}

std::string FormatSummary(const RunSummary& summary, const RunContext& context) {
  Json json;
  json["version"] = kVersion;
  json["command_line"] = context.command_line;
  json["outcome"] = context.outcome;
  json["sequence"] = {{"directory", context.sequence.directory},
                      {"format", context.sequence.format},
                      {"images", context.sequence.entries.size()},
                      {"warnings", context.sequence.warnings}};
  json["camera"] = CameraToJson(context.calibration);
  json["first_unreadable_image"] =
      context.first_unreadable.empty() ? Json() : Json(context.first_unreadable);
  json["realtime"] = RealtimeToJson(context.realtime);
  json.update(MeasuresToJson(summary, context.error, context.cost));
  json["readout_time_origin"] = context.calibration.readout_origin;
  json["options"] = OptionsToJson(context.configuration);
  return Dump(json);
}

std::string FormatBenchmarkJson(const Benchmark& benchmark) {
  Json json;
  json["version"] = kVersion;
  json["command_line"] = benchmark.command_line;
  json["build"] = benchmark.build;
  json["processors"] = benchmark.num_processors;
  json["changed_options"] = Json::object();
  for (const OptionText& option : benchmark.changed_options) {
    json["changed_options"][option.path] = option.value;
  }
  json["modes"] = benchmark.modes;
  json["runs"] = Json::array();
  for (const BenchmarkRun& run : benchmark.runs) {
    Json entry = {{"sequence", run.sequence}, {"mode", run.mode}};
    entry["failure"] = run.failure.empty() ? Json() : Json(run.failure);
    entry.update(MeasuresToJson(run.summary, run.error, run.cost));
    json["runs"].push_back(entry);
  }
  const MeanError mean = GeometricMean(benchmark);
  json["geometric_mean"] = {{"sequences", mean.num_sequences}, {"ape_rmse", Json::object()}};
  for (size_t i = 0; i < benchmark.modes.size(); ++i) {
    json["geometric_mean"]["ape_rmse"][benchmark.modes[i]] =
        NumberIf(mean.num_sequences, mean.ape[i]);
  }
  return Dump(json);
}

}  // namespace msc_vo
