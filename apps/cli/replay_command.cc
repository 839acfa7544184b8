// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/gravity_arguments.h"
#include "apps/cli/replay_views.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/diagnosis/sequence_check.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/results/online_results.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/results/summary_json.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct Arguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
  std::string windows;  // folder; empty: windows are not recorded
  GravityArguments gravity;
  ViewArguments view;
  std::string mode;
  std::string lines;
  std::string depth_sensor;
  bool no_points = false;
  bool no_lines = false;
  bool no_parallel = false;
  bool no_perpendicular = false;
  bool no_manhattan = false;
  bool realtime = false;
  bool no_check = false;
  bool print_config = false;
  bool all = false;       // of --print-config
  bool markdown = false;  // of --print-config
};

// Converts the short forms of frequent options to settings. --set takes precedence.
ConfigurationArguments WithShortcuts(const Arguments& arguments) {
  std::vector<std::string> settings;
  if (!arguments.mode.empty()) settings.push_back("mode=" + arguments.mode);
  if (!arguments.lines.empty()) settings.push_back("features.lines.detector=" + arguments.lines);
  if (!arguments.depth_sensor.empty()) {
    settings.push_back("features.depth_sensor=" + arguments.depth_sensor);
  }
  if (arguments.no_points) settings.push_back("use_points=false");
  if (arguments.no_lines) settings.push_back("use_lines=false");
  if (arguments.no_parallel) settings.push_back("mapping.pairs.parallel=false");
  if (arguments.no_perpendicular) settings.push_back("mapping.pairs.perpendicular=false");
  if (arguments.no_manhattan) settings.push_back("mapping.axes.enabled=false");
  // A live camera does not wait.
  if (arguments.realtime || IsLiveCamera(arguments.sequence.directory)) {
    settings.push_back("realtime=true");
  }
  ConfigurationArguments all = arguments.configuration;
  all.settings.insert(all.settings.begin(), settings.begin(), settings.end());
  return all;
}

// Writes every window of local bundle adjustment to `folder`, named by its keyframe.
WindowObserver WindowRecorder(const std::string& folder, const SequenceIndex& sequence) {
  if (folder.empty()) return {};
  RefuseToOverwrite(InputFolders(sequence), folder);
  MakeFolder(folder);
  return [folder](KeyframeId keyframe, const BundleAdjustmentOptions& options,
                  const WindowData& data) {
    const std::string name =
        FormatText("window_%06lld.txt", static_cast<long long>(keyframe));  // sorts by name
    const std::string path = (std::filesystem::path(folder) / name).string();
    WriteWindow(path, options, data);
    Log().debug("window written to {}", path);
  };
}

// Checks the sequence before the run. Returns the warnings. Throws std::runtime_error with the
// first error, with which no run can succeed.
std::vector<std::string> CheckBeforeRun(const RgbdDecoder& decoder) {
  std::vector<std::string> warnings;
  for (const Finding& finding : CheckSequenceQuickly(decoder)) {
    if (finding.severity == Severity::kError) {
      throw std::runtime_error(decoder.index().directory + ": " + Describe(finding) +
                               " (msc_vo check tells more; --no-check runs all the same)");
    }
    warnings.push_back(Describe(finding));
  }
  return warnings;
}

void PrintConfiguration(const Arguments& arguments, const ConfigurationArguments& settings,
                        const Configuration& configuration) {
  const OptionSelection selection = arguments.all ? OptionSelection::kAll : OptionSelection::kBasic;
  if (!arguments.markdown) {
    std::cout << FormatConfiguration(configuration, selection);
    return;
  }
  if (!settings.IsEmpty()) {
    throw std::runtime_error(
        "--markdown describes the defaults; leave out --config, --set and their short forms");
  }
  std::cout << FormatOptionsMarkdown(selection);
}

std::string OutputFolder(const Arguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  return (std::filesystem::path("out") / SequenceName(arguments.sequence.directory)).string();
}

int Replay(const Arguments& arguments) {
  const ConfigurationArguments settings = WithShortcuts(arguments);
  const Configuration configuration = MakeConfiguration(settings);
  PrintWarnings(DescribeIgnoredOptions(settings, configuration));
  if (arguments.print_config) {
    PrintConfiguration(arguments, settings, configuration);
    return kExitSuccess;
  }
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration, LiveCameras::kAllowed);
  PrintWarnings(decoder.index().warnings);
  std::vector<std::string> check_warnings;
  if (!arguments.no_check && !decoder.index().camera) check_warnings = CheckBeforeRun(decoder);
  PrintWarnings(check_warnings);
  const std::string output = OutputFolder(arguments);
  RefuseToOverwriteInputs(decoder.index(), arguments.configuration.config, output);
  MakeFolder(output);  // fails before the run if it cannot be created
  const WindowFactorCallback gravity = MakeGravityCallback(arguments.gravity, decoder.index());
  const InterruptGuard interrupt;
  OnlineResults online(output);
  ReplayViews views(arguments.view, decoder, configuration, arguments.run.max_frames);
  RunCallbacks callbacks;
  callbacks.frame = [&](const FrameResult& frame) {
    online.Add(frame);
    views.Add(frame, [&] { return interrupt.IsInterrupted(); });
  };
  callbacks.window = WindowRecorder(arguments.windows, decoder.index());
  callbacks.window_factors = gravity;
  callbacks.tracking = [&](const TrackedImage& tracked) { views.Show(tracked); };
  SequenceRun run = RunSequence(decoder, configuration, arguments.run, interrupt, callbacks);
  run.context.views = views.TakeViews();
  if (!run.HasImages()) {
    if (run.exit_code == kExitError) throw std::runtime_error(run.context.outcome);
    return run.exit_code;
  }
  std::vector<std::string>& warnings = run.context.sequence.warnings;
  warnings.insert(warnings.end(), check_warnings.begin(), check_warnings.end());
  WriteResultFiles(output, run.result, run.context);
  views.Complete((std::filesystem::path(output) / "report.html").string());
  if (arguments.run.json) {
    std::cout << FormatSummaryJson(run.summary, run.context) << std::flush;
  } else if (!arguments.run.quiet) {
    std::cout << FormatRunTable(run.summary, run.context, output) << std::flush;
  }
  if (run.exit_code == kExitError) {
    throw std::runtime_error(run.context.outcome + "\n(results so far are in " + output + ")");
  }
  if (run.exit_code == kExitTrackingFailed) {
    PrintError(run.context.outcome);
  }
  return run.exit_code;
}

// Short forms of frequent options.
void AddShortcuts(CLI::App* command, Arguments* arguments) {
  command
      ->add_option("--mode", arguments->mode,
                   "Ablation mode of the paper; default: the option mode (msc-vo)")
      ->check(CLI::IsMember(OptionChoices("mode")));
  command
      ->add_option("--lines", arguments->lines,
                   "Line detector: LSD, as in the paper, or edge drawing, which is faster")
      ->check(CLI::IsMember(OptionChoices("features.lines.detector")));
  command
      ->add_option("--depth-sensor", arguments->depth_sensor,
                   "Sensor that measured depth; default: the option features.depth_sensor (auto, "
                   "chosen from the depth images)")
      ->check(CLI::IsMember(OptionChoices("features.depth_sensor")));
  command->add_flag("--no-points", arguments->no_points, "Use lines only");
  command->add_flag("--no-lines", arguments->no_lines, "Use points only");
  command->add_flag("--no-parallel", arguments->no_parallel, "No pairs of parallel map lines");
  command->add_flag("--no-perpendicular", arguments->no_perpendicular,
                    "No pairs of perpendicular map lines");
  command->add_flag("--no-manhattan", arguments->no_manhattan, "No Manhattan axes");
  command->add_flag("--realtime", arguments->realtime,
                    "Process images at the pace of their time stamps, drop late images, and never "
                    "wait for a late map");
}

void AddPrintArguments(CLI::App* command, Arguments* arguments) {
  CLI::Option* print =
      command->add_flag("--print-config", arguments->print_config,
                        "Print the basic options as a file for --config, and exit");
  command->add_flag("--all", arguments->all, "With --print-config: also the advanced options")
      ->needs(print);
  command
      ->add_flag("--markdown", arguments->markdown,
                 "With --print-config: a reference of the options in Markdown")
      ->needs(print);
}

}  // namespace

Command AddReplayCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app->add_subcommand("replay", "Estimate the camera's trajectory from an RGB-D sequence");
  CLI::Option* sequence = AddSequenceArguments(command, &arguments->sequence);
  AddConfigurationArguments(command, &arguments->configuration);
  command->add_option("--output", arguments->output,
                      "Folder for the results; default: out/<name of the sequence>");
  AddShortcuts(command, arguments.get());
  AddGravityArguments(command, &arguments->gravity);
  AddViewArguments(command, &arguments->view);
  AddRunArguments(command, &arguments->run);
  command->add_flag("--no-check", arguments->no_check,
                    "Omit the quick check of the sequence before the run (see check)");
  command->add_option("--dump-windows", arguments->windows,
                      "Folder for the windows of local bundle adjustment, one file per "
                      "keyframe with its input (see solve-window)");
  AddPrintArguments(command, arguments.get());
  command->footer(HelpFooter("msc_vo replay my_sequence --output out/my_sequence"));
  command->callback([arguments, sequence] {
    if (sequence->empty() && !arguments->print_config) {
      // --view takes the argument behind it.
      if (!arguments->view.port.empty()) ViewPort(arguments->view);
      throw CLI::RequiredError("sequence");
    }
  });
  return {command, [arguments] { return Replay(*arguments); }};
}

}  // namespace msc_vo
