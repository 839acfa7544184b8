// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/evaluation_output.h"

#include "apps/cli/commands.h"
#include "apps/cli/output_file.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/report/trajectory_comparison.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr double kMillimetres = 1000.0;             // per metre
constexpr double kDegrees = RadiansToDegrees(1.0);  // per radian

std::string Row(const std::string& name, const ErrorStatistics& statistics, double factor,
                const char* unit) {
  if (statistics.count == 0) return FormatText("%-20s  no pairs at this distance\n", name.c_str());
  return FormatText("%-20s %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f %9.3f  %s\n", name.c_str(),
                    factor * statistics.rmse, factor * statistics.mean, factor * statistics.median,
                    factor * statistics.p95, factor * statistics.max, factor * statistics.min,
                    factor * statistics.std, unit);
}

// "1 frame", "0.5 metres".
std::string DeltaText(const RelativeDelta& delta) {
  std::string unit = ToString(delta.unit);
  if (delta.value == 1.0) unit.pop_back();
  return FormatNumber(delta.value) + " " + unit;
}

std::string AlignmentText(const TrajectoryError& error) {
  switch (error.alignment) {
    case Alignment::kSe3:
      return "alignment se3: rotation and translation\n";
    case Alignment::kSim3:
      return FormatText("alignment sim3: rotation, translation and scale %.6f\n", error.scale);
    case Alignment::kOrigin:
      return "alignment origin: the first matched poses are equal\n";
    case Alignment::kNone:
      return "alignment none\n";
  }
  return "";
}

}  // namespace

std::string FormatErrorTable(const TrajectoryError& error, const EvaluationContext& context) {
  std::string table = FormatText("%-20s %9s %9s %9s %9s %9s %9s %9s\n", "", "RMSE", "mean",
                                 "median", "95 %", "max", "min", "std");
  table += Row("APE", error.ape, kMillimetres, "mm");
  table += Row("rotation", error.rotation, kDegrees, "deg");
  const std::string delta = DeltaText(context.delta);
  table += Row("RPE " + delta, error.rpe.translation, kMillimetres, "mm");
  table += Row("RPE rot. " + delta, error.rpe.rotation, kDegrees, "deg");
  if (context.has_stamps) {
    table += Row("RPE per second", error.rpe_per_second.translation, kMillimetres, "mm/s");
    table += Row("RPE rot. per second", error.rpe_per_second.rotation, kDegrees, "deg/s");
  }
  table += Row("RPE per metre", error.rpe_per_metre.translation, kMillimetres, "mm/m");
  table += Row("RPE rot. per metre", error.rpe_per_metre.rotation, kDegrees, "deg/m");
  table += FormatText("APE SSE %.9g m^2; ", error.ape.sse) + AlignmentText(error);
  if (context.reference_format != "tum" || context.estimate_format != "tum") {
    table += "formats: ground truth " + context.reference_format + ", estimate " +
             context.estimate_format + "\n";
  }
  table += FormatText(
      "coverage %.2f %%: %d of %d ground-truth poses matched (%.2f %% of those in the "
      "time range of the estimate), %d estimated, path %.2f m\n",
      100.0 * error.coverage, error.num_matched, error.num_reference,
      100.0 * error.coverage_in_range, error.num_estimate, error.path_length);
  if (error.num_not_estimated > 0) {
    table += FormatText("skipped: %d poses marked as not estimated (--all-poses compares them)\n",
                        error.num_not_estimated);
  }
  return table;
}

std::string FormatLineTable(const LineError& error) {
  std::string table;
  if (error.num_matched > 0) {
    table += Row("line direction", error.direction, kDegrees, "deg");
    table += Row("line distance", error.distance, kMillimetres, "mm");
    table += Row("  across the view", error.across, kMillimetres, "mm");
  }
  return table + FormatText(
                     "lines: %d in the map, %d with enough observations and length, %d of these "
                     "matched with an edge; %d of %d edges found\n",
                     error.num_lines, error.num_counted, error.num_matched, error.num_edges_found,
                     error.num_edges);
}

std::string FormatSegmentTable(const std::vector<SegmentError>& segments, bool has_several_worlds) {
  std::string table;
  if (!segments.empty()) table += "APE of each segment, aligned by itself:\n";
  for (const SegmentError& segment : segments) {
    const std::string name = FormatText("  %d (world %d)", segment.segment, segment.world);
    table += segment.error.usable
                 ? Row(name, segment.error.ape, kMillimetres, "mm")
                 : FormatText("%-20s  ", name.c_str()) + segment.error.message + "\n";
  }
  if (has_several_worlds) {
    table += "the transform between worlds is unknown, and part of the errors of the whole above\n";
  }
  return table;
}

void WriteComparison(const std::string& path, const std::string& name, const TrajectoryError& error,
                     const EvaluationContext& context) {
  TrajectoryComparison comparison;
  comparison.title = "Evaluation of " + name;
  comparison.command_line = CommandLine();
  comparison.reference = error.matched_reference;
  comparison.estimate = error.matched_estimate;
  for (const PoseError& pose : error.per_pose) comparison.ape.push_back(pose.translation);
  comparison.ape_rmse = error.ape.rmse;
  comparison.ape_mean = error.ape.mean;
  comparison.ape_median = error.ape.median;
  comparison.has_stamps = context.has_stamps;
  const auto millimetres = [](double metres) {
    return FormatText("%.3f mm", kMillimetres * metres);
  };
  comparison.numbers = {
      {"APE RMSE", millimetres(error.ape.rmse),
       std::string("alignment ") + ToString(error.alignment)},
      {"APE mean", millimetres(error.ape.mean), "std " + millimetres(error.ape.std)},
      {"APE median", millimetres(error.ape.median),
       "min " + millimetres(error.ape.min) + ", max " + millimetres(error.ape.max)},
      {"rotation RMSE", FormatText("%.3f deg", kDegrees * error.rotation.rmse), ""},
      {"RPE RMSE", error.rpe.translation.count > 0 ? millimetres(error.rpe.translation.rmse) : "-",
       "over " + DeltaText(context.delta)},
      {"coverage", FormatText("%.1f %%", 100.0 * error.coverage),
       FormatText("%d poses", error.num_matched)}};
  if (error.alignment == Alignment::kSim3) {
    comparison.numbers.push_back({"scale", FormatText("%.6f", error.scale), ""});
  }
  for (const std::string& warning : error.warnings) {
    comparison.numbers.push_back({"warning", warning, ""});
  }
  WritePlotFile(path, ComparisonPage(comparison));
}

}  // namespace msc_vo
