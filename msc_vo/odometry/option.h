// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

// An enumeration as its names.
struct Choice {
  std::vector<std::string> names;  // in order of the enumerators
  std::function<int()> get;
  std::function<void(int)> set;
};

// What a number may be, both ends included. The upper ends keep memory and time of a run sane.
struct Range {
  double min = 0.0;
  double max = 0.0;

  bool Contains(double value) const { return value >= min && value <= max; }
};

// "from 0 to 256"
std::string ToString(const Range& range);

// One option: what it is called in a file, where its value lives, what it may be, what it means.
struct Option {
  std::string path;  // "tracking.pose.num_rounds"
  std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
               Choice>
      value;
  std::optional<Range> range;  // of a number; none: see what it belongs to
  std::string help;            // one line, with the unit
};

// The value, if the option is a number that is set.
std::optional<double> NumberOf(const Option& option);

// Pointers into `options`, grouped by section. This list is the only place that knows the options
// by name and their ranges: OdometryOptions::IsValid() and all reading and writing walk it.
std::vector<Option> ListOptions(OdometryOptions* options);

// Whether every number is within its range; if not, `error` names the option, its value and the
// range: "features.points.num_points = -1 must be from 0 to 20000 (per image, at most)".
bool AreInRange(const std::vector<Option>& options, std::string* error);

}  // namespace msc_vo
