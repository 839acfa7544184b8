// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "msc_vo/config/option_list.h"

namespace msc_vo {

/// Arguments that change options.
struct ConfigurationArguments {
  std::string config;                 ///< file; may be empty
  std::vector<std::string> settings;  ///< "path=value"
  std::string camera_file = {};       ///< may be empty
  std::string depth_sensor = {};      ///< empty: the option features.depth_sensor

  bool IsEmpty() const {
    return config.empty() && camera_file.empty() && depth_sensor.empty() && settings.empty();
  }
  /// The files that are read. Names may be empty.
  std::vector<std::string> InputFiles() const { return {config, camera_file}; }
};

/// Declares --config and --set.
void AddConfigurationArguments(CLI::App* command, ConfigurationArguments* arguments);
/// Declares --camera-file, for commands that read sequences.
void AddCameraFileArgument(CLI::App* command, ConfigurationArguments* arguments);
/// Declares --depth-sensor, for commands that measure depth.
void AddDepthSensorArgument(CLI::App* command, ConfigurationArguments* arguments);

/// Applies the file of options, that of the camera, the depth sensor, then the settings in their
/// order, to `configuration`. Throws std::runtime_error on an unknown option or an invalid value,
/// UsageError on one of the settings.
Configuration MakeConfiguration(const ConfigurationArguments& arguments,
                                Configuration configuration = {});

/// Warnings, one sentence each, about options that were set although the mode determines them.
std::vector<std::string> DescribeIgnoredOptions(const ConfigurationArguments& arguments,
                                                const Configuration& configuration);

/// The names of the values of an enumeration, for instance of the option "mode".
std::vector<std::string> OptionChoices(const std::string& path);

}  // namespace msc_vo
