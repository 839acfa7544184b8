// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/output_file.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/recording/window_json.h"
#include "msc_vo/text/files.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

constexpr char kWindowMark[] = "msc_vo_window";  // its version follows

struct SolveWindowArguments {
  std::string file;
  std::string output;  // empty: the solution is not written
  ConfigurationArguments configuration;
  bool json = false;
};

// The options in the file, changed by the arguments. Throws on a setting that is not an option of
// local bundle adjustment, because it would have no effect.
BundleAdjustmentOptions Options(const BundleAdjustmentOptions& recorded,
                                const ConfigurationArguments& arguments) {
  for (const std::string& setting : arguments.settings) {
    if (setting.rfind("mapping.window.", 0) != 0) {
      throw UsageError("--set: '" + setting +
                       "' is not an option of local bundle adjustment; those are mapping.window.*");
    }
  }
  Configuration configuration;
  configuration.odometry.mapping.window = recorded;
  return MakeConfiguration(arguments, configuration).odometry.mapping.window;
}

template <typename Items>
size_t NumFixed(const Items& items) {
  return std::count_if(items.begin(), items.end(), [](const auto& item) { return item.fixed; });
}

void PrintSummary(const WindowData& data, const BundleAdjustmentSummary& summary,
                  double milliseconds) {
  std::printf("%zu keyframes (%zu fixed), %zu points, %zu lines\n", data.keyframes.size(),
              NumFixed(data.keyframes), data.points.size(), data.lines.size());
  std::printf("%zu point and %zu line observations\n", data.point_observations.size(),
              data.line_observations.size());
  std::printf("%zu parallel and %zu perpendicular pairs, %zu axis alignments\n",
              data.parallel_pairs.size(), data.perpendicular_pairs.size(),
              data.axis_alignments.size());
  std::printf("%s\n  %.2f ms\n", summary.BriefReport().c_str(), milliseconds);
}

int Run(const SolveWindowArguments& arguments) {
  if (!arguments.output.empty()) {
    CheckOutputFile(arguments.output, {arguments.file, arguments.configuration.config}, {},
                    {kWindowMark});
  }
  RecordedWindow window = ReadWindow(arguments.file);
  window.options = Options(window.options, arguments.configuration);
  const Stopwatch stopwatch;
  BundleAdjustmentSummary summary;
  try {
    summary = LocalBundleAdjustment(window.options, &window.data);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(arguments.file + ": " + error.what());
  }
  const double milliseconds = stopwatch.Milliseconds();
  if (arguments.json) {
    std::cout << FormatWindowJson(summary, milliseconds) << std::flush;
  } else {
    PrintSummary(window.data, summary, milliseconds);
  }
  if (!summary.usable) {
    throw std::runtime_error(arguments.file + ": the solver failed: " + summary.message);
  }
  if (!arguments.output.empty()) WriteWindow(arguments.output, window.options, window.data);
  return kExitSuccess;
}

}  // namespace

Command AddSolveWindowCommand(CLI::App* app) {
  const auto arguments = std::make_shared<SolveWindowArguments>();
  CLI::App* command = app->add_subcommand(
      "solve-window", "Run local bundle adjustment on a window recorded by replay --dump-windows");
  command->add_option("file", arguments->file, "Window file (docs/window_file.md)")->required();
  command->add_option("--output", arguments->output,
                      "Window file for the result: refined poses and landmarks, rejection marks");
  command->add_flag("--json", arguments->json, "Print JSON");
  AddConfigurationArguments(command, &arguments->configuration);
  command->footer(
      "Options are those in the file, unless --config or --set change mapping.window.*.\n\n" +
      HelpFooter("msc_vo solve-window windows/window_000012.txt "
                 "--set mapping.window.parallel.enabled=false"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
