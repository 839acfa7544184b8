// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

/// The value of an enumeration, by name.
struct Choice {
  std::vector<std::string> names;  ///< in the order of the enumerators, which count from 0
  std::function<int()> get;
  std::function<void(int)> set;
};

/// A list of numbers that is either empty (not set) or of a fixed length.
struct NumberList {
  std::vector<double>* values = nullptr;
  size_t size = 0;
};

/// Valid interval of a number, both ends included, and its unit. The upper ends bound the memory
/// and the time of a run.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::string unit = "";  ///< "pixels", "per metre", ...; empty: dimensionless

  bool Contains(double value) const { return value >= min && value <= max; }
  bool IsBounded() const { return std::isfinite(min) && std::isfinite(max); }
};

/// "0 to 256 bits"; only the unit if the interval is unbounded.
std::string ToString(const Range& range);

/// Description of one option: its name, where its value is stored, its valid values and its help.
struct Option {
  using Value = std::variant<bool*, int*, double*, std::string*, std::optional<int>*,
                             std::optional<double>*, NumberList, Choice>;

  std::string path;  ///< name with its sections: "features.points.num_levels"
  Value value;
  std::optional<Range> range;  ///< every number has one
  std::string help;            ///< one or two sentences
  std::string when_to_change;  ///< a sentence; empty: the option is advanced

  /// Basic options are those that a user may want to change for a camera or a scene.
  bool IsBasic() const { return !when_to_change.empty(); }
  void MakeBasic(const std::string& when) { when_to_change = when; }
  /// Whether runs with another value may have other results: not if it only says where work runs.
  bool AffectsResults() const { return path != "threads" && path != "external_mapping"; }
};

/// The value if the option is a number and set.
std::optional<double> NumberOf(const Option& option);

/// All options, grouped by section, with pointers into `options`. This list is the only place that
/// defines their names, ranges and help; OdometryOptions::IsValid() and all readers and writers
/// iterate over it. Fields that EffectiveOptions() derives from others are not listed.
std::vector<Option> ListOptions(OdometryOptions* options);

/// The options of local bundle adjustment as a window file holds them: those of ListOptions(),
/// under the same names, and the thresholds and sigmas of BundleAdjustmentOptions that are not
/// among them, because a run leaves them at their defaults.
std::vector<Option> ListWindowOptions(BundleAdjustmentOptions* window);

/// Returns whether every number is in its range; otherwise `error` names the option, its value and
/// the range: "features.points.num_points = -1 must be from 0 to 20000 points".
bool AreInRange(const std::vector<Option>& options, std::string* error);

}  // namespace msc_vo
