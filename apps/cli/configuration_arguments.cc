// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/configuration_arguments.h"

#include <algorithm>

#include "apps/cli/commands.h"
#include "msc_vo/config/camera_options.h"
#include "msc_vo/config/options_file.h"

namespace msc_vo {

namespace {

// Whether the command line sets the option.
bool IsSet(const std::string& path, const ConfigurationArguments& arguments) {
  return std::any_of(arguments.settings.begin(), arguments.settings.end(),
                     [&](const std::string& setting) { return setting.rfind(path + "=", 0) == 0; });
}

void Set(const std::string& path, const std::string& value, Configuration* configuration) {
  const std::vector<Option> options = ListOptions(configuration);
  const Option* option = FindByPath(options, path);
  if (!option) {
    throw UsageError("--set: " +
                     UnknownOptionMessage(
                         options, path, "msc_vo replay --print-config --all lists the known ones"));
  }
  std::string expected;
  if (!SetOption(*option, value, &expected)) {
    throw UsageError("--set: " + path + " must be " + expected + ", not '" + value + "'");
  }
  if (path.rfind("camera.", 0) != 0) return;
  std::string& origin = configuration->camera.origin;
  if (origin.find("--set") == std::string::npos)
    origin += (origin.empty() ? "" : ", ") + std::string("--set");
}

}  // namespace

void AddConfigurationArguments(CLI::App* command, ConfigurationArguments* arguments) {
  command->add_option(
      "--config", arguments->config,
      "Options and camera: YAML as written by replay --print-config, or the settings "
      "of ORB-SLAM2 or ORB-SLAM3 (camera only)");
  command
      ->add_option("--set", arguments->settings,
                   "NAME=VALUE: any option of replay --print-config --all; may be repeated")
      ->allow_extra_args(false);
}

void AddCameraFileArgument(CLI::App* command, ConfigurationArguments* arguments) {
  command->add_option("--camera-file", arguments->camera_file,
                      "Camera, instead of that of --config or of the sequence: YAML as written by "
                      "calibrate --output, or a camera.txt");
}

void AddDepthSensorArgument(CLI::App* command, ConfigurationArguments* arguments) {
  command
      ->add_option("--depth-sensor", arguments->depth_sensor,
                   "Sensor that measured depth; default: the option features.depth_sensor (auto, "
                   "chosen from the depth images)")
      ->check(CLI::IsMember(OptionChoices("features.depth_sensor")));
}

Configuration MakeConfiguration(const ConfigurationArguments& arguments,
                                Configuration configuration) {
  if (!arguments.config.empty()) ReadConfiguration(arguments.config, &configuration);
  if (!arguments.camera_file.empty()) ReadCamera(arguments.camera_file, &configuration);
  if (!arguments.depth_sensor.empty()) {
    Set("features.depth_sensor", arguments.depth_sensor, &configuration);
  }
  for (const std::string& setting : arguments.settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw UsageError("--set: expected NAME=VALUE, not '" + setting + "'");
    }
    Set(setting.substr(0, equals), setting.substr(equals + 1), &configuration);
  }
  return configuration;
}

std::vector<std::string> DescribeIgnoredOptions(const ConfigurationArguments& arguments,
                                                const Configuration& configuration) {
  Configuration given = configuration, effective = EffectiveConfiguration(configuration);
  Configuration defaults;
  defaults.odometry.mode = configuration.odometry.mode;
  Configuration effective_defaults = EffectiveConfiguration(defaults);
  const std::vector<Option> given_options = ListOptions(&given);
  const std::vector<Option> effective_options = ListOptions(&effective);
  const std::vector<Option> default_options = ListOptions(&defaults);
  const std::vector<Option> effective_default_options = ListOptions(&effective_defaults);
  std::vector<std::string> warnings;
  for (size_t i = 0; i < given_options.size(); ++i) {
    const std::string& path = given_options[i].path;
    const std::string given_value = FormatOption(given_options[i]);
    const std::string effective_value = FormatOption(effective_options[i]);
    const std::string default_value = FormatOption(default_options[i]);
    const bool mode_decides = effective_value != given_value ||
                              default_value != FormatOption(effective_default_options[i]);
    if (!mode_decides || (given_value == default_value && !IsSet(path, arguments))) continue;
    warnings.push_back(path + "=" + given_value + " " +
                       (given_value == effective_value ? "changes nothing" : "is ignored") +
                       ": with mode=" + ToString(configuration.odometry.mode) + " it is always " +
                       effective_value);
  }
  return warnings;
}

std::vector<std::string> OptionChoices(const std::string& path) {
  Configuration defaults;
  const std::vector<Option> options = ListOptions(&defaults);
  return std::get<Choice>(FindByPath(options, path)->value).names;
}

}  // namespace msc_vo
