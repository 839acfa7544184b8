// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/option_list.h"

#include <algorithm>
#include <set>

#include "tests/support/fields.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::HasSubstr;

// Changes a value to a different one, which need not be valid.
struct Change {
  void operator()(bool* value) const { *value = !*value; }
  void operator()(int* value) const { *value += 1; }
  void operator()(double* value) const { *value = 2.0 * *value + 1.0; }
  void operator()(std::optional<double>* value) const { *value = value->value_or(0.0) + 0.5; }
  template <typename Enum>
  void operator()(Enum* value) const {
    *value = static_cast<Enum>(static_cast<int>(*value) == 0 ? 1 : 0);
  }
};

struct ToNumber {
  double operator()(const std::optional<double>& value) const { return value.value_or(-1e9); }
  template <typename T>
  double operator()(const T& value) const {
    return static_cast<double>(value);
  }
};

std::vector<double> ValuesOf(OdometryOptions options) {
  std::vector<double> values;
  VisitValues(&options, [&](auto* value) { values.push_back(ToNumber()(*value)); });
  return values;
}

OdometryOptions WithValueChanged(size_t index) {
  OdometryOptions options;
  size_t i = 0;
  VisitValues(&options, [&](auto* value) {
    if (i++ == index) Change()(value);
  });
  return options;
}

bool AreDerived(const OdometryOptions& options) {
  return ValuesOf(EffectiveOptions(options)) == ValuesOf(EffectiveOptions(OdometryOptions()));
}

std::string FormatWindowOptions(BundleAdjustmentOptions window) {
  std::string text;
  for (const Option& option : ListWindowOptions(&window)) text += FormatOption(option) + "\n";
  return text;
}

TEST(ListOptions, ListsEveryFieldThatIsNotDerived) {
  // Fields that a run leaves at their defaults, and which are fields for programs and tests:
  // rounds, iterations and noise of pose optimisation, segments.search_interval,
  // selection.min_observations, noise.prior and culling.redundant_ratio.
  constexpr size_t kNumUnlisted = 8;
  const std::string window_defaults = FormatWindowOptions(OdometryOptions().mapping.window);
  std::string last_listed;
  size_t num_listed = 0, num_unlisted = 0;
  const size_t num_values = ValuesOf(OdometryOptions()).size();
  for (size_t i = 0; i < num_values; ++i) {
    Configuration changed;
    changed.odometry = WithValueChanged(i);
    ASSERT_NE(ValuesOf(changed.odometry), ValuesOf(OdometryOptions())) << i;
    const std::vector<OptionText> listed = ChangedOptions(changed);
    EXPECT_LE(listed.size(), AreDerived(changed.odometry) ? 0u : 1u) << "behind " << last_listed;
    if (!listed.empty()) {
      last_listed = listed[0].path;
      ++num_listed;
    } else if (!AreDerived(changed.odometry) &&
               FormatWindowOptions(changed.odometry.mapping.window) == window_defaults) {
      ++num_unlisted;
    }
  }
  OdometryOptions options;
  EXPECT_EQ(ListOptions(&options).size(), num_listed);
  EXPECT_EQ(num_unlisted, kNumUnlisted);
}

TEST(ListWindowOptions, ListsEveryField) {
  const std::string defaults = FormatWindowOptions(BundleAdjustmentOptions());
  BundleAdjustmentOptions options;
  size_t num_fields = 0;
  VisitValues(&options, [&](auto* value) {
    const auto before = *value;
    Change()(value);
    EXPECT_NE(FormatWindowOptions(options), defaults) << num_fields;
    *value = before;
    ++num_fields;
  });
  EXPECT_EQ(ListWindowOptions(&options).size(), num_fields);
}

TEST(ListOptions, ListsEveryFieldOfTheCamera) {
  // All but `origin`. The model and the eight coefficients of a lens are a single field.
  Configuration configuration;
  const std::vector<Option> options = ListOptions(&configuration);
  const auto num_camera = std::count_if(options.begin(), options.end(), [](const Option& option) {
    return option.path.rfind("camera.", 0) == 0;
  });
  EXPECT_EQ(num_camera, static_cast<int>(NumFields<CameraSettings>()) - 1 + 8 +
                            static_cast<int>(NumFields<DepthCameraSettings>()) - 1 + 8);
}

TEST(ListOptions, DescribesEveryOption) {
  Configuration configuration;
  std::set<std::string> paths;
  for (const Option& option : ListOptions(&configuration)) {
    EXPECT_TRUE(paths.insert(option.path).second) << option.path;
    EXPECT_EQ(option.help.back(), '.') << option.path;
    if (option.IsBasic()) {
      EXPECT_EQ(option.when_to_change.back(), '.') << option.path;
    }
    EXPECT_THAT(option.help + FormatValidValues(option), testing::Not(HasSubstr("radian")))
        << option.path;
  }
}

TEST(ListOptions, GivesUnitsToAnglesAndSigmas) {
  OdometryOptions options;
  int num_checked = 0;
  for (const Option& option : ListOptions(&options)) {
    const std::string name = option.path.substr(option.path.rfind('.') + 1);
    if (name.find("angle") == std::string::npos && name.find("_sigma") == std::string::npos &&
        name.find("_radius") == std::string::npos) {
      continue;
    }
    if (!option.range) continue;  // a switch
    EXPECT_NE(option.range->unit, "") << option.path;
    ++num_checked;
  }
  EXPECT_GT(num_checked, 10);
}

TEST(ListOptions, HasAtMostFortyBasicOptions) {
  Configuration configuration;
  const std::vector<Option> options = ListOptions(&configuration);
  const auto num_basic = std::count_if(options.begin(), options.end(),
                                       [](const Option& option) { return option.IsBasic(); });
  EXPECT_LE(num_basic, 40);
  EXPECT_GE(num_basic, 30);
}

TEST(FormatValidValues, NamesUnitsLimitsAndChoices) {
  Configuration configuration;
  const auto valid_values = [&](const std::string& path) {
    for (const Option& option : ListOptions(&configuration)) {
      if (option.path == path) return FormatValidValues(option);
    }
    return std::string("no such option");
  };
  EXPECT_EQ(valid_values("camera.fx"), "pixels");
  EXPECT_EQ(valid_values("camera.preset"), "");
  EXPECT_EQ(valid_values("use_points"), "true, false");
  EXPECT_EQ(valid_values("features.lines.detector"), "lsd, edge-drawing");
  EXPECT_EQ(valid_values("tracking.point_matcher.max_distance"), "0 to 256 bits");
  EXPECT_EQ(valid_values("tracking.min_inlier_ratio"), "0 to 1");
}

}  // namespace
}  // namespace msc_vo
