// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "msc_vo/odometry/option.h"

namespace msc_vo {

/// The options of a Python class: those of the odometry whose names begin with `prefix`, which is
/// left out of the names in Python.
class OptionTable {
 public:
  OptionTable(const OdometryOptions& values, std::string prefix);

  const OdometryOptions& values() const { return values_; }

  /// Names in the order of docs/options.md.
  std::vector<std::string> Names() const;
  bool Contains(const std::string& name) const;
  /// The value as bool, int, float, str, or None if not set. Raises KeyError on an unknown name.
  pybind11::object Get(const std::string& name) const;
  /// Throws std::invalid_argument (ValueError) that names the option and its valid values.
  void Set(const std::string& name, pybind11::handle value);
  void SetAll(const pybind11::kwargs& values);
  /// "Options(mode='pl-vo')": the options that differ from those of `defaults`.
  std::string Describe(const std::string& class_name, const OptionTable& defaults) const;

 private:
  std::vector<Option> List() const;

  OdometryOptions values_;
  std::string prefix_;
};

/// All options of the odometry.
struct OptionsTable : OptionTable {
  explicit OptionsTable(const OdometryOptions& options = {}) : OptionTable(options, "") {}
};

/// The options of local bundle adjustment.
struct WindowOptionsTable : OptionTable {
  explicit WindowOptionsTable(const BundleAdjustmentOptions& options = {});
  const BundleAdjustmentOptions& window() const { return values().mapping.window; }
};

}  // namespace msc_vo
