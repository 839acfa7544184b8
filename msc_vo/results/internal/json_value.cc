// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/internal/json_value.h"

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

Json ValueOrNull(double count, double value) { return count > 0.0 ? Json(value) : Json(); }

Json CameraToJson(const PinholeCamera& camera) {
  return {{"fx", camera.fx}, {"fy", camera.fy},       {"cx", camera.cx},
          {"cy", camera.cy}, {"width", camera.width}, {"height", camera.height}};
}

Json ToJson(const TrajectoryError& error) {
  const RelativeError& second = error.rpe_per_second;
  const RelativeError& metre = error.rpe_per_metre;
  Json json;
  json["usable"] = error.usable;
  if (!error.usable) json["message"] = error.message;
  json["ape_rmse"] = ValueOrNull(error.ape.count, error.ape.rmse);
  json["ape_mean"] = ValueOrNull(error.ape.count, error.ape.mean);
  json["ape_median"] = ValueOrNull(error.ape.count, error.ape.median);
  json["ape_max"] = ValueOrNull(error.ape.count, error.ape.max);
  json["ape_min"] = ValueOrNull(error.ape.count, error.ape.min);
  json["ape_std"] = ValueOrNull(error.ape.count, error.ape.std);
  json["ape_sse"] = ValueOrNull(error.ape.count, error.ape.sse);
  json["alignment"] = ToString(error.alignment);
  json["scale"] = ValueOrNull(error.ape.count, error.scale);
  json["rotation_deg"] = ValueOrNull(error.rotation.count, RadiansToDegrees(error.rotation.rmse));
  json["ape_rot_deg"] = ValueOrNull(error.ape.count, RadiansToDegrees(error.ape_rotation.rmse));
  json["rpe_1s"] = ValueOrNull(second.translation.count, second.translation.rmse);
  json["rpe_1s_rot_deg"] =
      ValueOrNull(second.rotation.count, RadiansToDegrees(second.rotation.rmse));
  json["rpe_pairs"] = second.translation.count;
  json["rpe_1m"] = ValueOrNull(metre.translation.count, metre.translation.rmse);
  json["rpe_1m_rot_deg"] = ValueOrNull(metre.rotation.count, RadiansToDegrees(metre.rotation.rmse));
  json["rpe_1m_pairs"] = metre.translation.count;
  json["matched"] = error.num_matched;
  json["est"] = error.num_estimate;
  json["not_estimated"] = error.num_not_estimated;
  json["gt"] = error.num_reference;
  json["gt_in_range"] = error.num_reference_in_range;
  json["coverage"] = error.coverage;
  json["coverage_in_range"] = error.coverage_in_range;
  json["path_len"] = error.path_length;
  json["warnings"] = error.warnings;
  return json;
}

Json ToJson(const StageTimeStatistics& stage) {
  return {{"count", stage.count},
          {"mean", stage.mean},
          {"median", stage.median},
          {"p95", stage.p95},
          {"max", stage.max}};
}

std::string FormatJson(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace msc_vo
