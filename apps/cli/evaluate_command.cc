// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/error_json.h"
#include "msc_vo/results/ply_file.h"

namespace msc_vo {

namespace {

constexpr double kMillimetres = 1000.0;             // per metre
constexpr double kDegrees = RadiansToDegrees(1.0);  // per radian

struct Arguments {
  std::string truth;
  std::string estimate;
  EvaluationOptions options;
  std::string alignment = "positions";
  std::string lines, edges;  // empty: lines are not compared
  bool json = false;
};

void PrintRow(const char* name, const ErrorStatistics& statistics, double factor,
              const char* unit) {
  if (statistics.count == 0) {
    std::printf("%-20s  no pairs at this distance\n", name);
    return;
  }
  std::printf("%-20s %9.3f %9.3f %9.3f %9.3f %9.3f  %s\n", name, factor * statistics.rmse,
              factor * statistics.mean, factor * statistics.median, factor * statistics.p95,
              factor * statistics.max, unit);
}

void PrintTable(const TrajectoryError& error) {
  std::printf("%-20s %9s %9s %9s %9s %9s\n", "", "RMSE", "mean", "median", "95 %", "max");
  PrintRow("APE", error.ape, kMillimetres, "mm");
  PrintRow("rotation", error.rotation, kDegrees, "deg");
  PrintRow("RPE", error.rpe_per_second.translation, kMillimetres, "mm/s");
  PrintRow("RPE rotation", error.rpe_per_second.rotation, kDegrees, "deg/s");
  PrintRow("RPE", error.rpe_per_metre.translation, kMillimetres, "mm/m");
  PrintRow("RPE rotation", error.rpe_per_metre.rotation, kDegrees, "deg/m");
  std::printf(
      "coverage %.2f %%: %d of %d ground-truth poses matched (%.2f %% of those in the "
      "time range of the estimate), %d estimated, path %.2f m\n",
      100.0 * error.coverage, error.num_matched, error.num_reference,
      100.0 * error.coverage_in_range, error.num_estimate, error.path_length);
  if (error.num_not_estimated > 0) {
    std::printf("skipped: %d poses marked as not estimated (--all-poses compares them)\n",
                error.num_not_estimated);
  }
}

void PrintLines(const LineError& error) {
  if (error.num_matched > 0) {
    PrintRow("line direction", error.direction, kDegrees, "deg");
    PrintRow("line distance", error.distance, kMillimetres, "mm");
    PrintRow("  across the view", error.across, kMillimetres, "mm");
  }
  std::printf(
      "lines: %d in the map, %d with enough observations and length, %d of these matched with an "
      "edge; %d of %d edges found\n",
      error.num_lines, error.num_counted, error.num_matched, error.num_edges_found,
      error.num_edges);
}

std::vector<double> StampsOf(const std::vector<TimedPose>& poses) {
  std::vector<double> stamps;
  for (const TimedPose& pose : poses) stamps.push_back(pose.timestamp);
  return stamps;
}

// Converts the time stamps from `unit` to seconds.
void ToSeconds(const std::string& path, TimeUnit unit, std::vector<TimedPose>* poses) {
  if (unit == TimeUnit::kSeconds) return;
  PrintWarning(path + ": the time stamps are " + ToString(unit) + " and are converted to seconds");
  for (TimedPose& pose : *poses) pose.timestamp /= UnitsPerSecond(unit);
}

void PrintSkippedRows(const std::string& path, int num_skipped) {
  if (num_skipped == 0) return;
  std::printf("skipped: %d rows of %s with nan or inf\n", num_skipped, path.c_str());
}

int Run(const Arguments& arguments) {
  SkippedRows skipped;
  std::vector<TimedPose> truth = ReadTrajectory(arguments.truth, &skipped.reference);
  std::vector<TimedPose> estimate = ReadTrajectory(arguments.estimate, &skipped.estimate);
  const TimeUnit unit = GuessTimeUnit(StampsOf(truth));
  ToSeconds(arguments.truth, unit, &truth);
  ToSeconds(arguments.estimate, GuessTimeUnit(StampsOf(estimate), RangeOf(StampsOf(truth), unit)),
            &estimate);
  const TrajectoryError error = EvaluateTrajectory(truth, estimate, arguments.options);
  if (!error.usable) {
    throw std::runtime_error(arguments.estimate + " cannot be compared with " + arguments.truth +
                             ": " + error.message +
                             (error.num_not_estimated > 0
                                  ? "; --all-poses compares them"
                                  : "; are the time stamps of both in seconds of the same clock?"));
  }
  std::optional<LineError> line_error;
  if (!arguments.lines.empty()) {
    line_error = EvaluateLines(ReadEdgesPly(arguments.edges), ReadLinesPly(arguments.lines),
                               *AlignOrientations(truth, estimate, arguments.options));
  }
  if (arguments.json) {
    std::cout << FormatErrorJson(error, skipped, line_error);
  } else {
    PrintTable(error);
    PrintSkippedRows(arguments.truth, skipped.reference);
    PrintSkippedRows(arguments.estimate, skipped.estimate);
    if (line_error) PrintLines(*line_error);
  }
  return kExitSuccess;
}

}  // namespace

Command AddEvaluateCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "evaluate", "Compare a trajectory with the ground truth (both TUM: t tx ty tz qx qy qz qw)");
  command->add_option("ground_truth", arguments->truth, "Reference trajectory")->required();
  command->add_option("estimate", arguments->estimate, "Estimated trajectory")->required();
  CLI::Option* lines = command->add_option(
      "--lines", arguments->lines, "lines.ply of the same run, to be compared with --edges");
  CLI::Option* edges = command->add_option(
      "--edges", arguments->edges, "edges.ply of the sequence: the true edges of the scene");
  lines->needs(edges);
  edges->needs(lines);
  command->add_flag("--all-poses", arguments->options.all_poses,
                    "Also compare poses that are marked as not estimated");
  command
      ->add_option("--align", arguments->alignment,
                   "Alignment of the estimate before its errors are measured; none: both "
                   "trajectories are in the same world")
      ->check(CLI::IsMember({"positions", "orientations", "none"}))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON; metres and degrees");
  command
      ->add_option("--max-dt", arguments->options.max_time_difference,
                   "Maximum time between matched poses, seconds")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->footer(HelpFooter("msc_vo evaluate my_sequence/groundtruth.txt out/trajectory.txt"));
  return {command, [arguments] {
            arguments->options.alignment = AlignmentFromString(arguments->alignment);
            return Run(*arguments);
          }};
}

}  // namespace msc_vo
