// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/odometry/option.h"

namespace msc_vo {

/// The contents of a configuration file.
struct Configuration {
  CameraSettings camera;
  OdometryOptions odometry;
};

/// All options, grouped by section, with pointers into `configuration`.
std::vector<Option> ListOptions(Configuration* configuration);

/// The configuration with the options in effect, see EffectiveOptions.
Configuration EffectiveConfiguration(Configuration configuration);

/// Sets an option from text. Returns false, with a description of the valid values in `expected`
/// and the option unchanged, if the text cannot be parsed or the number is out of range.
bool SetOption(const Option& option, const std::string& text, std::string* expected);

/// The value as text, with as many digits as are needed to read it back exactly; empty: not set.
std::string FormatOption(const Option& option);

/// The valid values for help texts: "0 to 256 bits", "lsd, edge-drawing", "true, false"; for a
/// number without limits its unit; empty for a string.
std::string FormatValidValues(const Option& option);

/// An option and its value as text.
struct OptionText {
  std::string path;
  std::string value;
};

/// The options whose value differs from the default.
std::vector<OptionText> ChangedOptions(const Configuration& configuration);

/// The option with this path; null if there is none.
const Option* FindByPath(const std::vector<Option>& options, const std::string& path);

/// The error message for a path that is none of `options`: "unknown option 'x'; did you mean 'y'?",
/// or "unknown option 'x'; ADVICE" if none is similar.
std::string UnknownOptionMessage(const std::vector<Option>& options, const std::string& path,
                                 const std::string& advice);

}  // namespace msc_vo
