// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "apps/cli/argument_checks.h"
#include "apps/cli/commands.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/diagnosis/sequence_check.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

struct CheckArguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  SequenceCheckOptions options;
  bool all = false;
  bool json = false;
};

const char* Label(Severity severity) {
  return EnumName<Severity::kError>(severity, {"ok       ", "warning  ", "ERROR    "});
}

std::ptrdiff_t Count(const Findings& findings, Severity severity) {
  return std::count_if(findings.begin(), findings.end(),
                       [severity](const Finding& finding) { return finding.severity == severity; });
}

nlohmann::ordered_json ToJson(const Finding& finding) {
  nlohmann::ordered_json json = {{"check", finding.check}, {"severity", ToString(finding.severity)},
                                 {"text", finding.text},   {"fix", nullptr},
                                 {"value", nullptr},       {"unit", nullptr}};
  if (!finding.fix.empty()) json["fix"] = finding.fix;
  if (finding.value) {
    json["value"] = *finding.value;
    json["unit"] = finding.unit;
  }
  return json;
}

// The output of `msc_vo check --json`: "sequence", "format", "errors", "warnings", and "findings"
// in the order of the text output, each with "check", "severity", "text", "fix", "value" and
// "unit"; the last three are null if there is none. Invalid UTF-8, for instance in paths, is
// replaced.
std::string FormatFindingsJson(const SequenceIndex& sequence, const Findings& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) list.push_back(ToJson(finding));
  const nlohmann::ordered_json json = {{"sequence", sequence.directory},
                                       {"format", sequence.format},
                                       {"errors", Count(findings, Severity::kError)},
                                       {"warnings", Count(findings, Severity::kWarning)},
                                       {"findings", list}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int Run(const CheckArguments& arguments) {
  Configuration configuration = MakeConfiguration(arguments.configuration);
  const RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration);
  UseDepthSensorOf(decoder.index(), &configuration.odometry);
  SequenceCheckOptions options = arguments.options;
  options.odometry = configuration.odometry;
  if (arguments.all) options.max_images = decoder.size();
  const Findings findings = CheckSequence(decoder, options);
  const auto errors = Count(findings, Severity::kError);
  if (arguments.json) {
    std::cout << FormatFindingsJson(decoder.index(), findings) << std::flush;
    return errors > 0 ? kExitError : kExitSuccess;
  }
  std::cout << decoder.index().directory << " (" << decoder.index().format << ")\n";
  for (const Finding& finding : findings) {
    std::cout << Label(finding.severity) << Describe(finding) << "\n";
  }
  const auto warnings = Count(findings, Severity::kWarning);
  std::cout << errors << (errors == 1 ? " error, " : " errors, ") << warnings
            << (warnings == 1 ? " warning" : " warnings") << std::endl;
  return errors > 0 ? kExitError : kExitSuccess;
}

}  // namespace

Command AddCheckCommand(CLI::App* app) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = app->add_subcommand(
      "check", "Diagnose a sequence: files, time stamps, images, depth, calibration, ground truth");
  AddSequenceArguments(command, &arguments->sequence)->required();
  AddConfigurationArguments(command, &arguments->configuration);
  AddCameraFileArgument(command, &arguments->configuration);
  AddDepthSensorArgument(command, &arguments->configuration);
  command
      ->add_option("--images", arguments->options.max_images,
                   "Number of images to decode, evenly spaced")
      ->transform(WholeNumberFrom(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command->add_flag("--all", arguments->all, "Decode every image");
  command->add_flag("--deep", arguments->options.deep,
                    "Also run the odometry: calibration, time offsets and ground truth "
                    "against motion; takes up to a minute");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(HelpFooter("msc_vo check my_sequence"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
