// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>
#include <string>

#include "apps/cli/argument_checks.h"
#include "apps/cli/commands.h"
#include "apps/cli/run_export.h"

namespace msc_vo {

namespace {

// Refuses options that would have no effect.
void CheckOptions(const CLI::App& command, const RunExport& arguments) {
  const auto refuse_unless = [&](const char* option, bool has_effect) {
    if (command.get_option(option)->count() == 0 || has_effect) return;
    throw UsageError(std::string(option) + " has no effect on the format " + arguments.format +
                     "; leave it out");
  };
  const bool is_map = IsMapFormat(arguments.format);
  refuse_unless("--every", !is_map);
  refuse_unless("--all-poses", !is_map);
  refuse_unless("--binary", arguments.format == "colmap");
  refuse_unless("--images", arguments.format == "mcap");
  refuse_unless("--map", arguments.format == "mcap");
  const bool names_images = arguments.format == "colmap" && !arguments.sequence.directory.empty();
  refuse_unless("--session", names_images || !arguments.map.empty());
  const std::string problem = CheckPlyFileName(arguments.output);
  if (arguments.format == "ply" && !problem.empty()) throw UsageError("output: " + problem);
  for (const char* option : {"--voxel", "--max-depth", "--min-observations", "--max-memory"}) {
    refuse_unless(option, arguments.format == "ply");
  }
}

int Export(const CLI::App& command, RunExport arguments) {
  CheckOptions(command, arguments);
  if (IsMapFormat(arguments.format)) arguments.map = arguments.run;
  WriteExport(arguments);
  std::cout << "written to " << arguments.output << std::endl;
  return kExitSuccess;
}

}  // namespace

Command AddExportCommand(CLI::App* app) {
  const auto arguments = std::make_shared<RunExport>();
  arguments->overwrite = false;
  CLI::App* command = app->add_subcommand(
      "export", "Write the results of a run, or a map, in the format of another program");
  command
      ->add_option("run", arguments->run,
                   "Folder of results, trajectory, or, for colmap and g2o, a map file of --map")
      ->required();
  command->add_option("FORMAT", arguments->format, "Format of the other program")
      ->check(CLI::IsMember(ExportFormats()))
      ->required();
  command->add_option("output", arguments->output, "File to write; for colmap, a folder")
      ->required();
  command->add_option("--sequence", arguments->sequence.directory,
                      "Sequence whose images are used; default: that of the results, for colmap "
                      "numbers");
  AddLayoutArguments(command, &arguments->sequence);
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  command->add_option("--every", arguments->poses.every, "Export every N-th pose only")
      ->transform(WholeNumberFrom(1, 1e6))
      ->capture_default_str();
  command->add_flag("--all-poses", arguments->poses.all_poses,
                    "Also poses that are not estimated from the image, but predicted");
  command->add_flag("--binary", arguments->binary, "For colmap: the binary form");
  command->add_flag_callback(
      "--overwrite", [arguments] { arguments->overwrite = true; },
      "Replace a file that is not recognised as an earlier export of this format");
  command->add_flag("--images", arguments->images, "For mcap: also the colour images");
  command
      ->add_option("--map", arguments->map,
                   "For mcap: map of the run (replay --map), whose features are drawn into images "
                   "of the keyframes")
      ->type_name("FILE");
  command
      ->add_option(
          "--session", arguments->session,
          "For mcap with --map and colmap with --sequence: name of the session of the map, "
          "as map info prints it; default: found by the sequence")
      ->type_name("NAME");
  AddFusionArguments(command, &arguments->fusion);
  command->footer(HelpFooter("msc_vo export out/my_sequence nerfstudio transforms.json"));
  return {command, [arguments, command] { return Export(*command, *arguments); }};
}

}  // namespace msc_vo
