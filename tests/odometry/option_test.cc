// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option.h"

#include <cmath>
#include <limits>
#include <set>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::HasSubstr;

// Options that are also bounded by another option, for instance a minimum by a maximum.
const std::set<std::string> kRelated{"features.points.fast_threshold",
                                     "features.points.min_fast_threshold",
                                     "features.min_depth",
                                     "features.max_depth",
                                     "tracking.keyframes.min_interval",
                                     "tracking.keyframes.max_interval",
                                     "tracking.min_matches",
                                     "tracking.min_initial_features"};

struct NumberSetter {
  double number;

  void operator()(int* value) const { *value = static_cast<int>(number); }
  void operator()(double* value) const { *value = number; }
  void operator()(std::optional<int>* value) const { *value = static_cast<int>(number); }
  void operator()(std::optional<double>* value) const { *value = number; }
  template <typename T>
  void operator()(const T& /* no number */) const {
    FAIL() << "no number";
  }
};

bool IsWhole(const Option& option) {
  return std::holds_alternative<int*>(option.value) ||
         std::holds_alternative<std::optional<int>*>(option.value);
}

// The error of the options with one of them set to `number`; empty: they are valid.
std::string ErrorWith(size_t index, double number) {
  OdometryOptions options;
  const std::vector<Option> list = ListOptions(&options);
  std::visit(NumberSetter{number}, list[index].value);
  std::string error;
  return options.IsValid(&error) ? "" : error;
}

bool IsNumber(const Option& option) {
  return !std::holds_alternative<bool*>(option.value) &&
         !std::holds_alternative<std::string*>(option.value) &&
         !std::holds_alternative<NumberList>(option.value) &&
         !std::holds_alternative<Choice>(option.value);
}

TEST(OptionRanges, HaveARangeThatContainsTheDefault) {
  OdometryOptions options;
  int num_numbers = 0;
  for (const Option& option : ListOptions(&options)) {
    if (!IsNumber(option)) continue;
    ++num_numbers;
    ASSERT_TRUE(option.range.has_value()) << option.path;
    EXPECT_LT(option.range->min, option.range->max) << option.path;
    const std::optional<double> value = NumberOf(option);
    EXPECT_TRUE(!value || option.range->Contains(*value)) << option.path;
  }
  EXPECT_GT(num_numbers, 40);
}

TEST(OptionRanges, AreValidExactlyWithinTheirRange) {
  OdometryOptions defaults;
  const std::vector<Option> list = ListOptions(&defaults);
  for (size_t i = 0; i < list.size(); ++i) {
    if (!IsNumber(list[i])) continue;
    const Range& range = *list[i].range;
    if (kRelated.count(list[i].path) == 0) {
      EXPECT_EQ(ErrorWith(i, range.min), "") << list[i].path;
      EXPECT_EQ(ErrorWith(i, range.max), "") << list[i].path;
    }
    const double inf = std::numeric_limits<double>::infinity();
    const bool whole = IsWhole(list[i]);
    for (const double beyond : {whole ? range.min - 1.0 : std::nextafter(range.min, -inf),
                                whole ? range.max + 1.0 : std::nextafter(range.max, inf)}) {
      EXPECT_THAT(ErrorWith(i, beyond), Names(list[i].path + " = ", ToString(range))) << beyond;
    }
    if (whole) continue;
    EXPECT_THAT(ErrorWith(i, std::nan("")), HasSubstr(list[i].path + " = nan"));
    EXPECT_THAT(ErrorWith(i, inf), HasSubstr(list[i].path + " = inf"));
  }
}

TEST(OptionRanges, NameOptionValueAndRangeInErrors) {
  OdometryOptions options;
  options.features.points.num_points = 2147483647;
  std::string error;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "features.points.num_points = 2147483647 must be from 0 to 20000 points");
  options = {};
  options.tracking.local_map_radius = 0.0;
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "tracking.local_map_radius = 0 must be from 0.1 to 1000 pixels");
}

}  // namespace
}  // namespace msc_vo
