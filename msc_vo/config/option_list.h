// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

// An enumeration as its names.
struct Choice {
  std::vector<std::string> names;  // in order of the enumerators
  std::function<int()> get;
  std::function<void(int)> set;
};

// One option: what it is called in a file, where its value lives, what it means.
struct Option {
  std::string path;  // "tracking.pose.num_rounds"
  std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
               Choice>
      value;
  std::string help;  // one line, with the unit
};

// Everything that a configuration file can say. This list is the only place that knows the options
// by name: reading, writing and checking all walk it.
struct Configuration {
  CameraSettings camera;
  OdometryOptions odometry;
};

// Pointers into `configuration`, grouped by section.
std::vector<Option> ListOptions(Configuration* configuration);

// Sets an option from text. Returns false, with what was expected, if the text does not fit.
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
