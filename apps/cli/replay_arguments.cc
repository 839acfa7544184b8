// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/replay_arguments.h"

#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>

#include "apps/cli/argument_checks.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/replay_exports.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Short forms of frequent options.
void AddShortcuts(CLI::App* command, ReplayArguments* arguments) {
  command
      ->add_option("--mode", arguments->mode,
                   "Ablation mode of the paper; default: the option mode (msc-vo)")
      ->check(CLI::IsMember(OptionChoices("mode")));
  command
      ->add_option("--lines", arguments->lines,
                   "Line detector: LSD, as in the paper, or edge drawing, which is faster")
      ->check(CLI::IsMember(OptionChoices("features.lines.detector")));
  AddDepthSensorArgument(command, &arguments->configuration);
  command->add_flag("--no-points", arguments->no_points, "Use lines only");
  command->add_flag("--no-lines", arguments->no_lines, "Use points only");
  command->add_flag("--no-parallel", arguments->no_parallel, "No pairs of parallel map lines");
  command->add_flag("--no-perpendicular", arguments->no_perpendicular,
                    "No pairs of perpendicular map lines");
  command->add_flag("--no-manhattan", arguments->no_manhattan, "No Manhattan axes");
  command->add_flag("--no-planes", arguments->no_planes, "No planes of the depth images");
  command->add_flag("--no-loops", arguments->no_loops,
                    "Do not correct the map when the camera returns to a place");
  command->add_flag("--realtime", arguments->realtime,
                    "Process images at the pace of their time stamps, drop late images, and never "
                    "wait for a late map");
}

// Poses on standard output, in place of the table of results.
void AddPoseStreamArguments(CLI::App* command, ReplayArguments* arguments) {
  CLI::Option* text =
      command->add_flag("--stdout-poses", arguments->stdout_poses,
                        "Print every pose as soon as it is known, one line per image: time, "
                        "position, quaternion, standard deviations, status, world");
  CLI::Option* json = command->add_flag("--stdout-poses-json", arguments->stdout_poses_json,
                                        "The same with one JSON object per line");
  CLI::Option* summary = command->get_option("--json");
  text->excludes(json)->excludes(summary);
  json->excludes(summary);
}

void AddPrintArguments(CLI::App* command, ReplayArguments* arguments) {
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

// Declares --output, --overwrite, --resume and --checkpoint-interval.
void AddOutputArguments(CLI::App* command, ReplayArguments* arguments) {
  CLI::Option* output = command->add_option(
      "--output", arguments->output, "Folder for the results; default: out/<name of the sequence>");
  command->add_flag("--overwrite", arguments->overwrite,
                    "Write into a folder that holds the results of another sequence, and exports "
                    "over files that may be input");
  command
      ->add_option("--resume", arguments->resume,
                   "Continue the unfinished run whose results are in this folder, with the options "
                   "that it was started with")
      ->type_name("FOLDER")
      ->excludes(output);
  command
      ->add_option("--checkpoint-interval", arguments->checkpoint_interval,
                   "Seconds between the checkpoints that --resume continues from; 0: after every "
                   "image")
      ->check(NumberFrom(0.0, 1e6))
      ->default_str(FormatNumber(arguments->CheckpointInterval()));
}

}  // namespace

CLI::App* AddReplayArguments(CLI::App* app, ReplayArguments* arguments) {
  CLI::App* command =
      app->add_subcommand("replay", "Estimate the camera's trajectory from an RGB-D sequence");
  AddSequenceArguments(command, &arguments->sequence);
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  AddOutputArguments(command, arguments);
  AddShortcuts(command, arguments);
  AddGravityArguments(command, &arguments->gravity);
  AddMapArguments(command, &arguments->map);
  AddViewArguments(command, &arguments->view);
  AddRunArguments(command, &arguments->run);
  AddPoseStreamArguments(command, arguments);
  command->add_flag("--no-check", arguments->no_check,
                    "Omit the quick check of the sequence before the run (see check)");
  command->add_option("--dump-windows", arguments->windows,
                      "Folder for the windows of local bundle adjustment, one file per "
                      "keyframe with its input (see solve-window)");
  command
      ->add_option("--export", arguments->exports,
                   "FORMAT=PATH: also write the results as by msc_vo export; can be repeated")
      ->allow_extra_args(false)
      ->check(CheckExportText);
  AddPrintArguments(command, arguments);
  command->footer(HelpFooter("msc_vo replay my_sequence --output out/my_sequence"));
  return command;
}

void CheckReplayArguments(const CLI::App& command, const ReplayArguments& arguments) {
  if (!arguments.sequence.directory.empty() || arguments.print_config) return;
  if (arguments.resume.empty()) {
    // --view takes the argument behind it.
    if (!arguments.view.port.empty()) ViewPort(arguments.view);
    throw CLI::RequiredError("sequence");
  }
  const std::set<std::string> allowed = {"resume",       "quiet",
                                         "json",         "view",
                                         "view-address", "overlay",
                                         "strict",       "max-frames",
                                         "log-level",    "log-file",
                                         "help",         "checkpoint-interval",
                                         "stdout-poses", "stdout-poses-json"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string& name = option->get_single_name();
    if (option->count() == 0 || allowed.count(name) > 0) continue;
    throw CLI::ValidationError("--resume", "the run continues with its own options; leave out --" +
                                               name +
                                               ", or give the sequence and all options of the run");
  }
}

ConfigurationArguments WithShortcuts(const ReplayArguments& arguments) {
  std::vector<std::string> settings;
  if (!arguments.mode.empty()) settings.push_back("mode=" + arguments.mode);
  if (!arguments.lines.empty()) settings.push_back("features.lines.detector=" + arguments.lines);
  if (arguments.no_points) settings.push_back("use_points=false");
  if (arguments.no_lines) settings.push_back("use_lines=false");
  if (arguments.no_planes) settings.push_back("use_planes=false");
  if (arguments.no_parallel) settings.push_back("mapping.pairs.parallel=false");
  if (arguments.no_perpendicular) settings.push_back("mapping.pairs.perpendicular=false");
  if (arguments.no_manhattan) settings.push_back("mapping.axes.enabled=false");
  if (arguments.no_loops) settings.push_back("close_loops=false");
  // A live camera does not wait.
  if (arguments.realtime || IsLiveCamera(arguments.sequence.directory)) {
    settings.push_back("realtime=true");
  }
  ConfigurationArguments all = arguments.configuration;
  all.settings.insert(all.settings.begin(), settings.begin(), settings.end());
  return all;
}

ReplayArguments StoredArguments(const std::vector<std::string>& typed, const std::string& folder,
                                const ReplayArguments& given) {
  ReplayArguments arguments;
  CLI::App app;
  LogArguments log;
  AddLogArguments(&app, &log);
  AddLogArguments(AddReplayArguments(&app, &arguments), &log);
  app.parse(std::vector<std::string>(typed.rbegin(), typed.rend()));
  arguments.view = given.view;
  if (!given.view.overlay.empty()) {
    arguments.view.overlay = std::filesystem::absolute(given.view.overlay).string();
  }
  arguments.run.quiet = given.run.quiet;
  arguments.run.json = given.run.json;
  arguments.stdout_poses = given.stdout_poses;
  arguments.stdout_poses_json = given.stdout_poses_json;
  arguments.run.strict |= given.run.strict;
  if (given.run.max_frames > 0) arguments.run.max_frames = given.run.max_frames;
  if (given.checkpoint_interval) arguments.checkpoint_interval = given.checkpoint_interval;
  std::error_code error;
  std::filesystem::current_path(folder, error);
  if (error) {
    throw std::runtime_error(folder + ": the run was begun in this folder, which cannot " +
                             "be used (" + ErrorText(error) + "); give the sequence and the " +
                             "options of the run together with --resume");
  }
  return arguments;
}

}  // namespace msc_vo
