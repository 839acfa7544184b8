// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "msc_vo/config/option_list.h"

namespace msc_vo {

// How the user changes options.
struct ConfigurationArguments {
  std::string config;                 // file; may be empty
  std::vector<std::string> settings;  // "path=value"
};

// Declares --config and --set.
void AddConfigurationArguments(CLI::App* command, ConfigurationArguments* arguments);

// `configuration`, then the file, then the settings in their order, each over what was before.
// Throws std::runtime_error naming the option that is not known or whose value does not fit.
Configuration MakeConfiguration(const ConfigurationArguments& arguments,
                                Configuration configuration = {});

// What the user has set in `arguments`, or changed in their file, although the mode decides it: one
// sentence each.
std::vector<std::string> DescribeIgnoredOptions(const ConfigurationArguments& arguments,
                                                const Configuration& configuration);

// The names of what an option that is a choice may be, "mode" for instance.
std::vector<std::string> OptionChoices(const std::string& path);

}  // namespace msc_vo
