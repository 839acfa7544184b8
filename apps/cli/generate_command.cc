// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "apps/cli/bash_completion.h"
#include "apps/cli/commands.h"
#include "apps/cli/declarations.h"
#include "apps/cli/man_page.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

struct GenerateArguments {
  std::string kind;
  std::string output;
};

void WriteManPages(const CLI::App& app, const std::string& folder) {
  MakeFolder(folder);
  const std::filesystem::path path(folder);
  WriteFile((path / (app.get_name() + ".1")).string(), FormatMainPage(app));
  for (const CLI::App* command : VisibleCommands(app)) {
    WriteFile((path / (app.get_name() + "-" + command->get_name() + ".1")).string(),
              FormatCommandPage(app, *command));
  }
}

int Run(const CLI::App& app, const GenerateArguments& arguments) {
  if (arguments.kind == "man") {
    WriteManPages(app, arguments.output);
  } else {
    WriteFile(arguments.output, FormatBashCompletion(app));
  }
  return kExitSuccess;
}

}  // namespace

Command AddGenerateCommand(CLI::App* app) {
  const auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* command = app->add_subcommand(
      "generate", "Write documentation of the command line; used by the build of msc_vo");
  command->group("");  // hidden
  command->add_option("kind", arguments->kind, "Manual pages, or completion for bash")
      ->check(CLI::IsMember({"man", "completion"}))
      ->required();
  command
      ->add_option("output", arguments->output,
                   "Folder of the manual pages, file of the completion")
      ->required();
  return {command, [app, arguments] { return Run(*app, *arguments); }};
}

}  // namespace msc_vo
