// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/internal/run_json.h"

#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/calibrated_value.h"

namespace msc_vo {

namespace {

Json StagesToJson(const std::vector<StageTimeStatistics>& stages) {
  Json json = Json::object();
  for (const StageTimeStatistics& stage : stages) {
    json[stage.name] = ToJson(stage);
  }
  return json;
}

Json FramesToJson(const RunSummary& summary) {
  Json json = {{"count", summary.num_frames}};
  for (size_t i = 0; i < summary.status_counts.size(); ++i) {
    json[ToString(static_cast<TrackingStatus>(i))] = summary.status_counts[i];
  }
  json["tracked_ratio"] = summary.tracked_ratio;
  json["loss_causes"] = Json::object();
  for (size_t i = 0; i < summary.loss_causes.size(); ++i) {
    json["loss_causes"][ToString(static_cast<LossCause>(i))] = summary.loss_causes[i];
  }
  json["with_dynamic_objects"] = summary.num_frames_with_dynamic_objects;
  json["not_tracked_spans"] = Json::array();
  for (const NotTrackedSpan& span : summary.not_tracked) {
    json["not_tracked_spans"].push_back({{"first_frame", span.first_frame},
                                         {"last_frame", span.last_frame},
                                         {"start", span.start},
                                         {"end", span.end}});
  }
  return json;
}

Json SegmentsToJson(const RunSummary& summary) {
  Json json = Json::array();
  for (const Segment& segment : summary.segments) {
    json.push_back({{"first_frame", segment.first_frame},
                    {"last_frame", segment.last_frame},
                    {"estimated", segment.num_estimated},
                    {"world", segment.world},
                    {"in_map", segment.world == summary.map_world},
                    {"earlier_session", segment.is_earlier_session}});
    json.back()["joined"] = Json();
    if (!segment.join) continue;
    json.back()["joined"] = {{"frame", segment.join->frame},
                             {"keyframes", segment.join->num_keyframes},
                             {"sigma_rotation_deg", RadiansToDegrees(segment.join->rotation_sigma)},
                             {"sigma_translation", segment.join->translation_sigma}};
  }
  return json;
}

Json AxesToJson(const RunSummary& summary) {
  const MapAxes& axes = summary.axes;
  Json json = {{"state", ToString(axes.state)}};
  if (axes.state == AxesState::kNone) return json;
  const Eigen::Vector4d q = axes.world_from_axes.coeffs();
  json["refinements"] = axes.num_refinements;
  json["sigma_deg"] = RadiansToDegrees(axes.sigma);
  json["deviation_deg"] = RadiansToDegrees(axes.deviation);
  json["world_from_axes"] = {q.x(), q.y(), q.z(), q.w()};
  json["lines"] = summary.num_axis_lines;
  return json;
}

Json NoiseToJson(const NoiseScale& scale) {
  return {{"point_depth", scale.point_depth},
          {"line_pixel", scale.line_pixel},
          {"line_depth", scale.line_depth}};
}

Json CalibrationToJson(const RunSummary& summary) {
  Json json = {{"corrected", summary.calibration.IsCorrected()}};
  for (const CalibratedValue& value : ListCalibratedValues(summary)) {
    json[value.name] = {{"unit", value.unit},
                        {"value", value.value},
                        {"sigma", std::isfinite(value.sigma) ? Json(value.sigma) : Json()},
                        {"verdict", value.verdict},
                        {"log_odds", value.log_odds}};
  }
  return json;
}

Json ToJson(const BundleAdjustmentSummary& summary) {
  Json json = {{"usable", summary.usable}, {"iterations", summary.num_iterations}};
  for (const auto& [name, term] : summary.Terms()) {
    json[name] = {{"residual_blocks", term->num_residual_blocks},
                  {"rejected", term->num_rejected},
                  {"initial_cost", term->initial_cost},
                  {"final_cost", term->final_cost}};
  }
  return json;
}

Json LoopsToJson(const RunSummary& summary) {
  Json json = Json::array();
  for (const Loop& loop : summary.loops) {
    json.push_back({{"frame", loop.frame},
                    {"reference", loop.reference},
                    {"keyframes", loop.num_keyframes},
                    {"correction_deg", RadiansToDegrees(loop.rotation)},
                    {"correction", loop.translation}});
  }
  return json;
}

}  // namespace

Json MeasurementsToJson(const RunSummary& summary, const std::optional<TrajectoryError>& error,
                        const RunCost& cost) {
  Json json;
  json["frames"] = FramesToJson(summary);
  json["segments"] = SegmentsToJson(summary);
  json["loops"] = LoopsToJson(summary);
  json["map"] = {{"keyframes", summary.num_keyframes},
                 {"points", summary.num_points},
                 {"lines", summary.num_lines},
                 {"planes", summary.num_planes}};
  json["manhattan_axes"] = AxesToJson(summary);
  json["noise_scale"] = NoiseToJson(summary.noise_scale);
  json["readout_time"] = summary.readout_time;
  json["self_calibration"] = CalibrationToJson(summary);
  json["depth_sensor"] = ToString(summary.depth_sensor);
  json["last_local_ba"] = ToJson(summary.last_local_ba);
  json["error"] = error ? ToJson(*error) : Json();
  json["stages_ms"] = StagesToJson(summary.stages);
  json["wall_seconds"] = cost.seconds;
  json["frames_per_second"] = ValueOrNull(cost.seconds, summary.num_frames / cost.seconds);
  json["processor_seconds"] = cost.processor_seconds;
  json["peak_memory_mib"] = cost.peak_memory;
  return json;
}

}  // namespace msc_vo
