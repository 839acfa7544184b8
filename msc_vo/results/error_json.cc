// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/error_json.h"

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/internal/json_value.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

Json ToJson(const ErrorStatistics& statistics, double factor = 1.0) {
  return {{"rmse", ValueOrNull(statistics.count, factor * statistics.rmse)},
          {"mean", ValueOrNull(statistics.count, factor * statistics.mean)},
          {"median", ValueOrNull(statistics.count, factor * statistics.median)},
          {"p95", ValueOrNull(statistics.count, factor * statistics.p95)},
          {"max", ValueOrNull(statistics.count, factor * statistics.max)},
          {"min", ValueOrNull(statistics.count, factor * statistics.min)},
          {"std", ValueOrNull(statistics.count, factor * statistics.std)},
          {"sse", ValueOrNull(statistics.count, factor * factor * statistics.sse)}};
}

Json ToJson(const LineError& error) {
  return {{"count", error.num_lines},
          {"counted", error.num_counted},
          {"matched", error.num_matched},
          {"edges", error.num_edges},
          {"edges_found", error.num_edges_found},
          {"direction_deg", ToJson(error.direction, RadiansToDegrees(1.0))},
          {"distance", ToJson(error.distance)},
          {"distance_across", ToJson(error.across)}};
}

Json ToJson(const RelativeError& error, const RelativeDelta& delta) {
  return {{"delta", delta.value},
          {"unit", ToString(delta.unit)},
          {"all_pairs", delta.all_pairs},
          {"pairs", error.translation.count},
          {"translation", ToJson(error.translation)},
          {"rotation_deg", ToJson(error.rotation, RadiansToDegrees(1.0))}};
}

}  // namespace

const char* ToString(DeltaUnit unit) {
  return EnumName<DeltaUnit::kSeconds>(unit, {"frames", "metres", "seconds"});
}

std::string FormatErrorJson(const TrajectoryError& error, const SkippedRows& skipped,
                            const EvaluationContext& context, const std::optional<LineError>& lines,
                            const std::vector<SegmentError>& segments) {
  Json json = ToJson(error);
  json["rpe"] = ToJson(error.rpe, context.delta);
  json["gt_format"] = context.reference_format;
  json["est_format"] = context.estimate_format;
  json["est_skipped"] = skipped.estimate;
  json["gt_skipped"] = skipped.reference;
  if (lines) json["lines"] = ToJson(*lines);
  for (const SegmentError& segment : segments) {
    Json entry = {{"segment", segment.segment}, {"world", segment.world}};
    entry.update(ToJson(segment.error));
    json["segments"].push_back(entry);
  }
  return FormatJson(json);
}

}  // namespace msc_vo
