// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "msc_vo/odometry/option.h"

namespace msc_vo {

/// Collects options section by section. The functions that add an option return it, valid until the
/// next one is added, so that it can be made a basic one.
class OptionLister {
 public:
  /// Adds an option that is not a number.
  template <typename T>
  Option& Add(const std::string& name, T* value, const std::string& help) {
    return Push(name, value, std::nullopt, help);
  }
  template <typename T>
  Option& Add(const std::string& name, T* value, const Range& range, const std::string& help) {
    return Push(name, value, range, help);
  }

  /// Adds an enumeration. `names`: in the order of the enumerators, which count from 0.
  template <typename Enum>
  Option& AddChoice(const std::string& name, Enum* value, std::vector<std::string> names,
                    const std::string& help) {
    Choice choice{std::move(names), [value] { return static_cast<int>(*value); },
                  [value](int index) { *value = static_cast<Enum>(index); }};
    return Push(name, std::move(choice), std::nullopt, help);
  }

  /// Adds a list of `size` numbers, which is empty if it is not set.
  Option& AddList(const std::string& name, std::vector<double>* values, size_t size,
                  const std::string& help) {
    return Push(name, NumberList{values, size}, std::nullopt, help);
  }

  /// Puts the options that `list` adds into section `name`.
  template <typename T>
  void Section(const std::string& name, T* value, void (*list)(T*, OptionLister*)) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    list(value, this);
    prefix_ = outer;
  }

  std::vector<Option> Take() { return std::move(options_); }

 private:
  Option& Push(const std::string& name, Option::Value value, std::optional<Range> range,
               const std::string& help) {
    options_.push_back({prefix_ + name, std::move(value), std::move(range), help, ""});
    return options_.back();
  }

  std::string prefix_;
  std::vector<Option> options_;
};

/// The sections of OdometryOptions.
void ListFeatures(FrameBuilderOptions* features, OptionLister* list);
void ListTracking(TrackerOptions* tracking, OptionLister* list);
void ListSnapshots(SnapshotOptions* snapshots, OptionLister* list);
void ListMapping(MapperOptions* mapping, OptionLister* list);

}  // namespace msc_vo
