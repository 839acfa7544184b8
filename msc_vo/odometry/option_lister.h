// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "msc_vo/odometry/option.h"

namespace msc_vo {

// Collects options, section by section.
class OptionLister {
 public:
  // Of what is no number, or of a number whose range depends on others.
  template <typename T>
  void Add(const std::string& name, T* value, const std::string& help) {
    options_.push_back({prefix_ + name, value, std::nullopt, help});
  }
  template <typename T>
  void Add(const std::string& name, T* value, const Range& range, const std::string& help) {
    options_.push_back({prefix_ + name, value, range, help});
  }

  // `names` in the order of the enumerators, which count from 0.
  template <typename Enum>
  void AddChoice(const std::string& name, Enum* value, std::vector<std::string> names,
                 const std::string& help) {
    Choice choice{std::move(names), [value] { return static_cast<int>(*value); },
                  [value](int index) { *value = static_cast<Enum>(index); }};
    options_.push_back({prefix_ + name, std::move(choice), std::nullopt, help});
  }

  // What `list` adds goes into section `name`.
  template <typename T>
  void Section(const std::string& name, T* value, void (*list)(T*, OptionLister*)) {
    const std::string outer = prefix_;
    prefix_ += name + ".";
    list(value, this);
    prefix_ = outer;
  }

  std::vector<Option> Take() { return std::move(options_); }

 private:
  std::string prefix_;
  std::vector<Option> options_;
};

// The sections of OdometryOptions.
void ListFeatures(FrameBuilderOptions* features, OptionLister* list);
void ListNormals(SurfaceNormalOptions* normals, OptionLister* list);
void ListTracking(TrackerOptions* tracking, OptionLister* list);
void ListMapping(MapperOptions* mapping, OptionLister* list);

// Sections that both tracking and mapping have.
void ListPointMatcher(PointMatcherOptions* matcher, OptionLister* list);
void ListLineMatcher(LineMatcherOptions* matcher, OptionLister* list);
void ListTerm(TermOptions* term, OptionLister* list);

// The terms and thresholds that the pose and the window problem share.
template <typename ProblemOptions>
void ListTerms(ProblemOptions* problem, OptionLister* list) {
  list->Section("point_reprojection", &problem->point_reprojection, ListTerm);
  list->Section("point_depth", &problem->point_depth, ListTerm);
  list->Section("line_reprojection", &problem->line_reprojection, ListTerm);
  list->Section("line_depth", &problem->line_depth, ListTerm);
  list->Add("reject_chi2_2", &problem->reject_chi2_2, {0.001, 10000},
            "chi-square limit of 2 residuals");
  list->Add("reject_chi2_3", &problem->reject_chi2_3, {0.001, 10000},
            "chi-square limit of 3 residuals");
  list->Add("reject_chi2_4", &problem->reject_chi2_4, {0.001, 10000},
            "chi-square limit of 4 residuals");
}

}  // namespace msc_vo
