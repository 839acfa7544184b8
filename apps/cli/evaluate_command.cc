// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/evaluation_output.h"
#include "apps/cli/map_argument.h"
#include "apps/cli/output_file.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/results/error_json.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

const std::map<std::string, DeltaUnit>& DeltaUnits() {
  static const std::map<std::string, DeltaUnit> units = {
      {"frames", DeltaUnit::kFrames},   {"metres", DeltaUnit::kMetres},
      {"seconds", DeltaUnit::kSeconds}, {"f", DeltaUnit::kFrames},
      {"m", DeltaUnit::kMetres},        {"s", DeltaUnit::kSeconds}};
  return units;
}

struct EvaluateArguments {
  std::string truth;
  std::string estimate;
  std::vector<std::string> formats;  // none, one for both, or one each
  EvaluationOptions options;
  std::string alignment = "se3";
  std::string delta_unit = "frames";
  std::string lines, edges;  // empty: lines are not compared
  std::string plot;          // empty: none
  bool json = false;
};

// Two trajectories on the same clock.
struct Trajectories {
  TrajectoryFile truth;
  TrajectoryFile estimate;
};

void RequirePoses(const std::string& path, const TrajectoryFile& file) {
  const std::string problem = file.DescribeLack();
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
}

Trajectories ReadTrajectories(const EvaluateArguments& arguments) {
  std::optional<TrajectoryFormat> truth_format, estimate_format;
  if (!arguments.formats.empty()) {
    truth_format = TrajectoryFormatFromName(arguments.formats.front());
    estimate_format = TrajectoryFormatFromName(arguments.formats.back());
  }
  for (const std::string& path : {arguments.truth, arguments.estimate}) {
    RefuseMapFile(path, kNoTrajectory);
  }
  Trajectories trajectories{ReadTrajectoryFile(arguments.truth, truth_format),
                            ReadTrajectoryFile(arguments.estimate, estimate_format)};
  RequirePoses(arguments.truth, trajectories.truth);
  RequirePoses(arguments.estimate, trajectories.estimate);
  std::vector<std::string> warnings;
  ConvertToSeconds(arguments.truth, arguments.estimate, &trajectories.truth, &trajectories.estimate,
                   &warnings);
  PrintWarnings(warnings);
  ShareStamps(arguments.truth, arguments.estimate, &trajectories.truth, &trajectories.estimate);
  return trajectories;
}

std::string LeftOutText(const std::string& path, const TrajectoryFile& trajectory) {
  return trajectory.num_left_out == 0 ? "" : path + ": " + trajectory.DescribeLeftOut() + "\n";
}

TrajectoryError Evaluate(const EvaluateArguments& arguments, const Trajectories& trajectories,
                         const EvaluationContext& context) {
  TrajectoryError error =
      EvaluateTrajectory(trajectories.truth.poses, trajectories.estimate.poses, arguments.options);
  if (!error.usable) {
    const std::string remedy = DescribeRemedy(error, "--all-poses");
    throw std::runtime_error(arguments.estimate + " cannot be compared with " + arguments.truth +
                             ": " + error.message + (remedy.empty() ? "" : "; " + remedy));
  }
  PrintWarnings(error.warnings);
  if (!context.has_stamps) error.rpe_per_second = {};
  return error;
}

int Run(EvaluateArguments arguments) {
  arguments.options.alignment = AlignmentFromString(arguments.alignment);
  arguments.options.rpe_delta.unit = DeltaUnits().at(arguments.delta_unit);
  const std::string problem = arguments.options.rpe_delta.Problem();
  if (!problem.empty()) {
    throw UsageError("--delta: " + problem + ", not " +
                     FormatNumber(arguments.options.rpe_delta.value) +
                     "; --delta-unit chooses metres or seconds");
  }
  if (!arguments.lines.empty() && arguments.options.alignment != Alignment::kSe3) {
    throw UsageError("--lines compares lines after a rigid alignment; leave out --align");
  }
  // The errors are printed even if the plots cannot be written.
  RefuseToOverwrite({arguments.truth, arguments.estimate, arguments.lines, arguments.edges},
                    arguments.plot);
  RefuseToReplace(arguments.plot, {kComparisonMark}, {});
  const Trajectories trajectories = ReadTrajectories(arguments);
  const TrajectoryFile &truth = trajectories.truth, &estimate = trajectories.estimate;
  const EvaluationContext context{ToString(truth.format), ToString(estimate.format),
                                  truth.has_stamps || estimate.has_stamps,
                                  arguments.options.rpe_delta};
  const TrajectoryError error = Evaluate(arguments, trajectories, context);
  const std::vector<SegmentError> segments =
      EvaluateSegments(truth.poses, estimate.poses, arguments.options);
  std::optional<LineError> line_error;
  if (!arguments.lines.empty()) {
    line_error = EvaluateLines(ReadEdgesPly(arguments.edges), ReadLinesPly(arguments.lines),
                               *AlignOrientations(truth.poses, estimate.poses, arguments.options));
  }
  if (arguments.json) {
    const SkippedRows skipped{truth.num_left_out, estimate.num_left_out};
    std::cout << FormatErrorJson(error, skipped, context, line_error, segments) << std::flush;
  } else {
    std::cout << FormatErrorTable(error, context)
              << FormatSegmentTable(segments, HasSeveralWorlds(estimate.poses))
              << LeftOutText(arguments.truth, truth) << LeftOutText(arguments.estimate, estimate);
    if (line_error) std::cout << FormatLineTable(*line_error);
  }
  if (!arguments.plot.empty()) {
    const std::string name = std::filesystem::path(arguments.estimate).filename().string();
    WriteComparison(arguments.plot, name, error, context);
    if (!arguments.json) std::cout << "plots: " << arguments.plot << "\n";
  }
  return kExitSuccess;
}

template <typename Value>
std::vector<std::string> KeysOf(const std::map<std::string, Value>& values) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values) keys.push_back(key);
  return keys;
}

void AddOptionsOfTheField(CLI::App* command, EvaluateArguments* arguments) {
  command
      ->add_option("--align", arguments->alignment,
                   "Alignment of the estimate: rigid (se3), with scale (sim3), the first pose "
                   "(origin), none")
      ->check(CLI::IsMember({"se3", "sim3", "origin", "none"}))
      ->capture_default_str();
  command
      ->add_option("--delta", arguments->options.rpe_delta.value,
                   "Distance between the poses of the relative error (RPE)")
      ->check(NumberFrom(1e-6, 1e6))
      ->capture_default_str();
  command
      ->add_option("--delta-unit", arguments->delta_unit,
                   "Unit of --delta: frames, metres of path or seconds (f, m, s)")
      ->check(CLI::IsMember(KeysOf(DeltaUnits())))
      ->capture_default_str();
  command->add_flag("--all-pairs", arguments->options.rpe_delta.all_pairs,
                    "RPE over a pair from every pose, not only over consecutive pairs");
  command
      ->add_option("--format", arguments->formats,
                   "Format of both files, or REFERENCE,ESTIMATE; default: detected")
      ->delimiter(',')
      ->expected(1, 2)
      ->allow_extra_args(false)
      ->check(CLI::IsMember(TrajectoryFormatNames()));
  command
      ->add_option("--plot", arguments->plot,
                   "Write plots of the trajectories and their errors: .html or .svg")
      ->check(CheckPlotFileName);
}

}  // namespace

Command AddEvaluateCommand(CLI::App* app) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command = app->add_subcommand(
      "evaluate", "Compare a trajectory with the ground truth (TUM, KITTI or EuRoC)");
  command->add_option("ground_truth", arguments->truth, "Reference trajectory")->required();
  command->add_option("estimate", arguments->estimate, "Estimated trajectory")->required();
  CLI::Option* lines = command->add_option(
      "--lines", arguments->lines, "lines.ply of the same run, to be compared with --edges");
  CLI::Option* edges = command->add_option(
      "--edges", arguments->edges, "edges.ply of the sequence: the true edges of the scene");
  lines->needs(edges);
  edges->needs(lines);
  AddOptionsOfTheField(command, arguments.get());
  command->add_flag("--all-poses", arguments->options.all_poses,
                    "Also compare poses that are marked as not estimated");
  command->add_flag("--json", arguments->json, "Print JSON; metres and degrees");
  command
      ->add_option("--max-dt", arguments->options.max_time_difference,
                   "Maximum time between matched poses, seconds")
      ->check(NumberFrom(0.0, 1e6))
      ->capture_default_str();
  command->footer(HelpFooter("msc_vo evaluate my_sequence/groundtruth.txt out/trajectory.txt"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
