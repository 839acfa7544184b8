// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/results/online_results.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

struct Arguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
  std::string windows;  // folder; empty: windows are not recorded
  std::string mode;
  std::string lines;
  bool no_points = false;
  bool no_lines = false;
  bool no_parallel = false;
  bool no_perpendicular = false;
  bool no_manhattan = false;
  bool realtime = false;
  bool print_config = false;
};

// The short names of frequent options are settings like any other; a --set has the last word.
ConfigurationArguments WithShortcuts(const Arguments& arguments) {
  std::vector<std::string> settings;
  if (!arguments.mode.empty()) settings.push_back("mode=" + arguments.mode);
  if (!arguments.lines.empty()) settings.push_back("features.lines.detector=" + arguments.lines);
  if (arguments.no_points) settings.push_back("use_points=false");
  if (arguments.no_lines) settings.push_back("use_lines=false");
  if (arguments.no_parallel) settings.push_back("mapping.pairs.parallel=false");
  if (arguments.no_perpendicular) settings.push_back("mapping.pairs.perpendicular=false");
  if (arguments.no_manhattan) settings.push_back("mapping.axes.enabled=false");
  if (arguments.realtime) settings.push_back("realtime=true");
  ConfigurationArguments all = arguments.configuration;
  all.settings.insert(all.settings.begin(), settings.begin(), settings.end());
  return all;
}

// Writes every window into `folder`, named by its keyframe.
WindowObserver WindowRecorder(const std::string& folder, const SequenceIndex& sequence) {
  if (folder.empty()) return {};
  RefuseToOverwrite(InputFolders(sequence), folder);
  MakeFolder(folder);
  return [folder](KeyframeId keyframe, const BundleAdjustmentOptions& options,
                  const WindowData& data) {
    const std::string name =
        FormatText("window_%06lld.txt", static_cast<long long>(keyframe));  // sorts by name
    WriteWindow((std::filesystem::path(folder) / name).string(), options, data);
  };
}

int Replay(const Arguments& arguments) {
  const ConfigurationArguments settings = WithShortcuts(arguments);
  const Configuration configuration = MakeConfiguration(settings);
  PrintWarnings(DescribeIgnoredOptions(settings, configuration));
  if (arguments.print_config) {
    std::cout << FormatConfiguration(configuration);
    return kExitSuccess;
  }
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration);
  PrintWarnings(decoder.index().warnings);
  const std::string output =
      !arguments.output.empty()
          ? arguments.output
          : (std::filesystem::path("out") / SequenceName(arguments.sequence.directory)).string();
  RefuseToOverwriteInputs(decoder.index(), arguments.configuration.config, output);
  MakeFolder(output);  // a wrong name shows before the work, not after it
  const InterruptGuard interrupt;
  OnlineResults online(output);
  const SequenceRun run = RunSequence(
      decoder, configuration, arguments.run, interrupt,
      [&](const FrameResult& frame) { online.Add(frame); },
      WindowRecorder(arguments.windows, decoder.index()));
  if (!run.HasImages()) {
    if (run.exit_code == kExitError) throw std::runtime_error(run.context.outcome);
    return run.exit_code;
  }
  WriteResultFiles(output, run.result, run.context);
  if (!arguments.run.quiet) {
    std::cout << FormatRunTable(run.summary, run.context, output) << std::flush;
  }
  if (run.exit_code == kExitError) {
    throw std::runtime_error(run.context.outcome + "\n(what was computed until then is in " +
                             output + ")");
  }
  if (run.exit_code == kExitTrackingFailed) {
    std::cerr << "msc_vo: error: " << run.context.outcome << std::endl;
  }
  return run.exit_code;
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
  command
      ->add_option("--mode", arguments->mode, "What of the method is used; default: the options'")
      ->check(CLI::IsMember(OptionChoices("mode")));
  command->add_option("--lines", arguments->lines, "Line detector: the paper's, or a fast one")
      ->check(CLI::IsMember(OptionChoices("features.lines.detector")));
  command->add_flag("--no-points", arguments->no_points, "Lines alone");
  command->add_flag("--no-lines", arguments->no_lines, "Points alone");
  command->add_flag("--no-parallel", arguments->no_parallel, "No pairs of parallel map lines");
  command->add_flag("--no-perpendicular", arguments->no_perpendicular,
                    "No pairs of perpendicular map lines");
  command->add_flag("--no-manhattan", arguments->no_manhattan, "No Manhattan axes");
  command->add_flag("--realtime", arguments->realtime,
                    "Images appear when their time stamps say; no frame waits for a map that is "
                    "late, and images that come too late are dropped");
  AddRunArguments(command, &arguments->run);
  command->add_option("--dump-windows", arguments->windows,
                      "Folder for the windows that the mapper solves, one file per keyframe, as "
                      "they are before (see solve-window)");
  command->add_flag("--print-config", arguments->print_config,
                    "Print all options with their meanings, as a file for --config, and exit");
  command->footer(HelpFooter("msc_vo replay my_sequence --output out/my_sequence"));
  command->callback([arguments, sequence] {
    if (sequence->empty() && !arguments->print_config) {
      throw CLI::RequiredError("sequence");
    }
  });
  return {command, [arguments] { return Replay(*arguments); }};
}

}  // namespace msc_vo
