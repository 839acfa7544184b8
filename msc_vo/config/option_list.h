// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/odometry/option.h"

namespace msc_vo {

// Everything that a configuration file can say.
struct Configuration {
  CameraSettings camera;
  OdometryOptions odometry;
};

// Pointers into `configuration`, grouped by section.
std::vector<Option> ListOptions(Configuration* configuration);

// Sets an option from text. Returns false, with what was expected and the option as it was, if the
// text or its number does not fit.
bool SetOption(const Option& option, const std::string& text, std::string* expected);

// The value as text, with as many digits as are needed to read it back; empty: not set.
std::string FormatOption(const Option& option);

// An option that has a value, as text.
struct OptionText {
  std::string path;
  std::string value;
};

// Those whose value is not the default.
std::vector<OptionText> ChangedOptions(const Configuration& configuration);

// The option whose path is most like `path`, for "did you mean ...?"; null if none is alike.
const Option* FindSimilar(const std::vector<Option>& options, const std::string& path);

}  // namespace msc_vo
