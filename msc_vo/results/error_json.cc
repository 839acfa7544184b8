// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/error_json.h"

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/internal/json_value.h"

namespace msc_vo {

namespace {

Json ToJson(const ErrorStatistics& statistics, double factor = 1.0) {
  return {{"rmse", ValueOrNull(statistics.count, factor * statistics.rmse)},
          {"mean", ValueOrNull(statistics.count, factor * statistics.mean)},
          {"median", ValueOrNull(statistics.count, factor * statistics.median)},
          {"p95", ValueOrNull(statistics.count, factor * statistics.p95)},
          {"max", ValueOrNull(statistics.count, factor * statistics.max)}};
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

}  // namespace

std::string FormatErrorJson(const TrajectoryError& error, const SkippedRows& skipped,
                            const std::optional<LineError>& lines) {
  Json json = ToJson(error);
  json["est_skipped"] = skipped.estimate;
  json["gt_skipped"] = skipped.reference;
  if (lines) json["lines"] = ToJson(*lines);
  return FormatJson(json);
}

}  // namespace msc_vo
