// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/config/option_list.h"

namespace msc_vo {

/// Reads a configuration file over `configuration`; options that the file does not contain keep
/// their values. The file is YAML with the sections and names of ListOptions, or a flat YAML file
/// of ORB-SLAM2 or ORB-SLAM3, of which only the camera is read. Throws std::runtime_error naming
/// file and line: on an unknown name (with the most similar known one), a value of the wrong type
/// or out of range, or malformed YAML.
void ReadConfiguration(const std::string& path, Configuration* configuration);

/// Which options are written.
enum class OptionSelection { kBasic, kAll };

/// The options with their values, meanings and valid values, as a file for ReadConfiguration.
/// Options that are not set (the camera) are written as comments.
std::string FormatConfiguration(const Configuration& configuration, OptionSelection selection);

/// The options that differ from their defaults, as a file for ReadConfiguration without
/// explanations. `title`: a comment in the first line.
std::string FormatChangedOptions(const Configuration& configuration, const std::string& title);

/// The options with their defaults as Markdown tables: first the basic ones, then the advanced ones
/// by section. docs/options.md is this text.
std::string FormatOptionsMarkdown(OptionSelection selection);

}  // namespace msc_vo
