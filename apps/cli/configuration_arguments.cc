// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/configuration_arguments.h"

#include <algorithm>
#include <stdexcept>

#include "msc_vo/config/options_file.h"

namespace msc_vo {

namespace {

const Option* FindOption(const std::vector<Option>& options, const std::string& path) {
  const auto option = std::find_if(options.begin(), options.end(),
                                   [&](const Option& known) { return known.path == path; });
  return option == options.end() ? nullptr : &*option;
}

void Set(const std::string& path, const std::string& value, Configuration* configuration) {
  const std::vector<Option> options = ListOptions(configuration);
  const Option* option = FindOption(options, path);
  if (!option) {
    const Option* similar = FindSimilar(options, path);
    throw std::runtime_error("--set: unknown option '" + path + "'" +
                             (similar ? "; did you mean '" + similar->path + "'?"
                                      : "; msc_vo replay --print-config lists all"));
  }
  std::string expected;
  if (!SetOption(*option, value, &expected)) {
    throw std::runtime_error("--set: " + path + " must be " + expected + ", not '" + value + "'");
  }
  if (path.rfind("camera.", 0) != 0) return;
  std::string& origin = configuration->camera.origin;
  if (origin.find("--set") == std::string::npos)
    origin += (origin.empty() ? "" : ", ") + std::string("--set");
}

}  // namespace

void AddConfigurationArguments(CLI::App* command, ConfigurationArguments* arguments) {
  command->add_option("--config", arguments->config,
                      "Options and camera: our YAML (see replay --print-config) or ORB-SLAM's");
  command
      ->add_option("--set", arguments->settings,
                   "NAME=VALUE: any option of replay --print-config; may be repeated")
      ->allow_extra_args(false);
}

Configuration MakeConfiguration(const ConfigurationArguments& arguments,
                                Configuration configuration) {
  if (!arguments.config.empty()) ReadConfiguration(arguments.config, &configuration);
  for (const std::string& setting : arguments.settings) {
    const size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw std::runtime_error("--set: expected NAME=VALUE, not '" + setting + "'");
    }
    Set(setting.substr(0, equals), setting.substr(equals + 1), &configuration);
  }
  return configuration;
}

std::vector<std::string> OptionChoices(const std::string& path) {
  Configuration defaults;
  const std::vector<Option> options = ListOptions(&defaults);
  return std::get<Choice>(FindOption(options, path)->value).names;
}

}  // namespace msc_vo
