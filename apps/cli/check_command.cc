// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/datasets/sequence_check.h"

namespace msc_vo {

namespace {

struct Arguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  SequenceCheckOptions options;
  bool all = false;
  bool json = false;
};

const char* Name(Severity severity) {
  switch (severity) {
    case Severity::kGood:
      return "ok";
    case Severity::kWarning:
      return "warning";
    case Severity::kError:
      return "error";
  }
  return "";
}

void PrintJson(const SequenceIndex& index, const std::vector<Finding>& findings) {
  nlohmann::ordered_json json = {{"directory", index.directory},
                                 {"format", index.format},
                                 {"images", index.entries.size()},
                                 {"findings", nlohmann::ordered_json::array()}};
  for (const Finding& finding : findings) {
    json["findings"].push_back({{"severity", Name(finding.severity)}, {"text", finding.text}});
  }
  std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

const char* Label(Severity severity) {
  switch (severity) {
    case Severity::kGood:
      return "ok       ";
    case Severity::kWarning:
      return "warning  ";
    case Severity::kError:
      return "ERROR    ";
  }
  return "";
}

int Run(const Arguments& arguments) {
  const RgbdDecoder decoder =
      OpenDecoder(arguments.sequence, MakeConfiguration(arguments.configuration));
  SequenceCheckOptions options = arguments.options;
  if (arguments.all) options.max_images = decoder.size();
  const std::vector<Finding> findings = CheckSequence(decoder, options);
  if (!arguments.json) {
    std::cout << decoder.index().directory << " (" << decoder.index().format << ")\n";
  }
  int warnings = 0;
  int errors = 0;
  for (const Finding& finding : findings) {
    if (!arguments.json) std::cout << Label(finding.severity) << finding.text << "\n";
    warnings += finding.severity == Severity::kWarning;
    errors += finding.severity == Severity::kError;
  }
  if (arguments.json) {
    PrintJson(decoder.index(), findings);
    return errors > 0 ? kExitError : kExitSuccess;
  }
  std::cout << errors << (errors == 1 ? " error, " : " errors, ") << warnings
            << (warnings == 1 ? " warning" : " warnings") << std::endl;
  return errors > 0 ? kExitError : kExitSuccess;
}

}  // namespace

Command AddCheckCommand(CLI::App* app) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app->add_subcommand(
      "check", "Check a sequence: files, image sizes, time stamps, depth, camera, ground truth");
  AddSequenceArguments(command, &arguments->sequence)->required();
  AddConfigurationArguments(command, &arguments->configuration);
  command
      ->add_option("--images", arguments->options.max_images,
                   "Number of images to decode, evenly spaced")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_flag("--all", arguments->all, "Decode every image");
  command->add_flag("--json", arguments->json, "Print the findings as JSON");
  command->footer(HelpFooter("msc_vo check my_sequence"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
