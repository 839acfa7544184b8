// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>
#include <string>

#include "apps/cli/commands.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/results/map_export.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct MapCommandArguments {
  std::string action;
  std::string file;
  std::string output;
};

void PrintInfo(const std::string& file) {
  const MapFileSummary summary = SummarizeMap(file);
  int64_t num_keyframes = 0;
  for (const MapFileSummary::SubMap& submap : summary.submaps) {
    num_keyframes += submap.num_keyframes;
  }
  std::cout << file << ": version " << summary.version << " of the format, written by "
            << summary.program << "\n"
            << FormatText("%.1f MB, %.1f KB per keyframe\n", 1e-6 * summary.num_bytes,
                          num_keyframes > 0 ? 1e-3 * summary.num_bytes / num_keyframes : 0.0);
  for (const MapFileSummary::Session& session : summary.sessions) {
    std::cout << "session '" << session.name << "': " << session.num_keyframes << " keyframes\n";
  }
  for (const MapFileSummary::SubMap& submap : summary.submaps) {
    std::cout << "submap " << submap.id << ": " << submap.num_keyframes << " keyframes, "
              << submap.num_points << " points, " << submap.num_lines << " lines\n";
  }
  std::cout << summary.num_loop_edges << " loop edges" << std::endl;
}

int Run(const MapCommandArguments& arguments) {
  if (arguments.action == "info") {
    PrintInfo(arguments.file);
  } else if (arguments.action == "check") {
    CheckMap(arguments.file);
    std::cout << arguments.file << ": no damage" << std::endl;
  } else {
    const MapContents contents = LoadMap(arguments.file);
    RefuseToOverwrite({arguments.file}, arguments.output);
    ExportMap(contents, arguments.output);
    std::cout << "written to " << arguments.output << std::endl;
  }
  return kExitSuccess;
}

void Check(const MapCommandArguments& arguments) {
  const bool exports = arguments.action == "export";
  if (exports && arguments.output.empty()) throw CLI::RequiredError("--output");
  if (!exports && !arguments.output.empty()) {
    throw CLI::ValidationError("--output", "only map export writes files; leave it out");
  }
}

}  // namespace

Command AddMapCommand(CLI::App* app) {
  const auto arguments = std::make_shared<MapCommandArguments>();
  CLI::App* command =
      app->add_subcommand("map", "Describe, check or export a map file of replay --map");
  command
      ->add_option("action", arguments->action,
                   "info: what the file contains; check: read all of it; export: write points and "
                   "lines (PLY), keyframes (TUM) and the pose graph (g2o)")
      ->required()
      ->check(CLI::IsMember({"info", "check", "export"}));
  command->add_option("file", arguments->file, "Map file (docs/map_file.md)")->required();
  command->add_option("--output", arguments->output, "Folder for the files of export")
      ->type_name("FOLDER");
  command->callback([arguments] { Check(*arguments); });
  command->footer(HelpFooter("msc_vo map export home.map --output out/home"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
