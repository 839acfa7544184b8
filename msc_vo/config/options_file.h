// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/config/option_list.h"

namespace msc_vo {

// Reads a configuration over `configuration`: what the file does not say stays as it is. The file
// is YAML with the sections and names of ListOptions, or a flat YAML of ORB-SLAM2 or ORB-SLAM3, of
// which the camera is taken.
// Throws std::runtime_error naming file and line: a name that is not known (with the nearest one
// that is), a value of the wrong type, text that is no YAML.
void ReadConfiguration(const std::string& path, Configuration* configuration);

// All options with their values and meanings, as a file that ReadConfiguration reads. What is not
// set (the camera) stands there as a comment.
std::string FormatConfiguration(const Configuration& configuration);

}  // namespace msc_vo
