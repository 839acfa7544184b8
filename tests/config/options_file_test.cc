// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/options_file.h"

#include <set>
#include <type_traits>
#include <utility>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Number of fields of an aggregate: how many values its braces take, at most.
struct Anything {
  template <typename T>
  operator T() const;
};
template <typename T, typename Fields, typename = void>
constexpr bool kTakes = false;
template <typename T, size_t... I>
constexpr bool kTakes<T, std::index_sequence<I...>,
                      std::void_t<decltype(T{(static_cast<void>(I), Anything{})...})>> = true;
template <typename T, size_t N = 64>
constexpr size_t NumFields() {
  if constexpr (kTakes<T, std::make_index_sequence<N>>) {
    return N;
  } else {
    return NumFields<T, N - 1>();
  }
}

// Number of options and sections right below `section` ("": the top).
size_t NumListed(const std::string& section) {
  Configuration configuration;
  std::set<std::string> names;
  for (const Option& option : ListOptions(&configuration)) {
    if (option.path.rfind(section, 0) != 0) continue;
    const std::string rest = option.path.substr(section.size());
    names.insert(rest.substr(0, rest.find('.')));
  }
  return names.size();
}

class OptionsFileTest : public TemporaryFolder {
 protected:
  Configuration Read(const std::string& text) {
    WriteText("options.yaml", text);
    Configuration configuration;
    ReadConfiguration(Path("options.yaml"), &configuration);
    return configuration;
  }
  std::string ErrorOf(const std::string& text) {
    return MessageOf([&] { Read(text); });
  }
};

TEST_F(OptionsFileTest, TheDefaultsAreValidAndEveryOptionHasItsOwnNameAndHelp) {
  Configuration configuration;
  std::string error;
  EXPECT_TRUE(configuration.odometry.IsValid(&error)) << error;
  std::set<std::string> paths;
  for (const Option& option : ListOptions(&configuration)) {
    EXPECT_TRUE(paths.insert(option.path).second) << option.path;
    EXPECT_FALSE(option.help.empty()) << option.path;
  }
  EXPECT_GT(paths.size(), 80u);
}

TEST_F(OptionsFileTest, NoFieldOfTheOptionsIsForgotten) {
  // And the camera. The three snapshot options stand where users look for them.
  EXPECT_EQ(NumListed(""), NumFields<OdometryOptions>() + 1);
  EXPECT_EQ(NumFields<SnapshotOptions>(), 3);
  EXPECT_EQ(NumListed("features."), NumFields<FrameBuilderOptions>());
  EXPECT_EQ(NumListed("features.points."), NumFields<PointExtractorOptions>());
  EXPECT_EQ(NumListed("features.lines."), NumFields<LineExtractorOptions>());
  EXPECT_EQ(NumListed("features.noise."), NumFields<SensorNoiseOptions>());
  EXPECT_EQ(NumListed("features.line_fit."), NumFields<LineFitOptions>());
  EXPECT_EQ(NumListed("tracking."), NumFields<TrackerOptions>());
  EXPECT_EQ(NumListed("tracking.point_matcher."), NumFields<PointMatcherOptions>());
  EXPECT_EQ(NumListed("tracking.line_matcher."), NumFields<LineMatcherOptions>());
  EXPECT_EQ(NumListed("tracking.pose."), NumFields<PoseOptions>());
  EXPECT_EQ(NumListed("tracking.pose.line_depth."), NumFields<TermOptions>());
  EXPECT_EQ(NumListed("tracking.keyframes."), NumFields<KeyframePolicyOptions>());
  EXPECT_EQ(NumListed("tracking.relocalizer."), NumFields<RelocalizerOptions>());
  EXPECT_EQ(NumListed("mapping."), NumFields<MapperOptions>() + 2);  // two latencies
  EXPECT_EQ(NumListed("mapping.fusion."), NumFields<FusionOptions>());
  EXPECT_EQ(NumListed("mapping.selection."), NumFields<WindowSelectionOptions>());
  EXPECT_EQ(NumListed("mapping.window."), NumFields<BundleAdjustmentOptions>());
  EXPECT_EQ(NumListed("mapping.culling."), NumFields<CullingOptions>());
}

TEST_F(OptionsFileTest, ReadsWhatIsThereAndKeepsTheRest) {
  const Configuration configuration = Read(
      "# mine\nmode: pl-vo\ncamera:\n  fx: 500.5\n  width: 320\n  preset: tum-fr1\n"
      "use_points: off\ntracking:\n  wide_radius: 80\n  pose:\n    num_rounds: 7\n"
      "    line_depth: {enabled: false}\nmapping:\n");
  EXPECT_EQ(configuration.odometry.mode, Mode::kPlVo);
  EXPECT_FALSE(configuration.odometry.use_points);
  EXPECT_EQ(*configuration.camera.fx, 500.5);
  EXPECT_EQ(*configuration.camera.width, 320);
  EXPECT_EQ(configuration.camera.preset, "tum-fr1");
  EXPECT_FALSE(configuration.camera.fy.has_value());
  EXPECT_EQ(configuration.odometry.tracking.wide_radius, 80.0);
  EXPECT_EQ(configuration.odometry.tracking.pose.num_rounds, 7);
  EXPECT_FALSE(configuration.odometry.tracking.pose.line_depth.enabled);
  EXPECT_EQ(configuration.odometry.tracking.prediction_radius, TrackerOptions().prediction_radius);
}

TEST_F(OptionsFileTest, AnEmptyFileChangesNothing) {
  EXPECT_EQ(FormatConfiguration(Read("")), FormatConfiguration(Configuration()));
  EXPECT_EQ(FormatConfiguration(Read("# nothing\n")), FormatConfiguration(Configuration()));
}

TEST_F(OptionsFileTest, EveryOptionSurvivesWritingAndReading) {
  Configuration configuration;
  // A value for each option that differs from its default.
  for (const Option& option : ListOptions(&configuration)) {
    const std::string before = FormatOption(option);
    bool changed = false;
    for (const char* text : {"true", "false", "17", "0.12345678901234567", "pl-vo", "end-points",
                             "lsd", "edge-drawing", "ceres-dense-schur", "never"}) {
      std::string expected;
      changed = changed || (text != before && SetOption(option, text, &expected));
    }
    EXPECT_TRUE(changed) << option.path;
    EXPECT_NE(FormatOption(option), before) << option.path;
  }
  const std::string text = FormatConfiguration(configuration);
  EXPECT_EQ(FormatConfiguration(Read(text)), text);
  EXPECT_NE(text, FormatConfiguration(Configuration()));
}

TEST_F(OptionsFileTest, UnknownNamesGetASuggestion) {
  EXPECT_THAT(ErrorOf("\ntracking:\n  wide_raduis: 80\n"),
              AllOf(HasSubstr("options.yaml:3: unknown option 'tracking.wide_raduis'"),
                    HasSubstr("did you mean 'tracking.wide_radius'?")));
  EXPECT_THAT(ErrorOf("max_lines: 80\n"), HasSubstr("did you mean 'features.lines.max_lines'?"));
  EXPECT_THAT(ErrorOf("xyzzy: 80\n"), HasSubstr("--print-config lists all"));
}

TEST_F(OptionsFileTest, WrongTypesAreErrors) {
  EXPECT_THAT(ErrorOf("tracking:\n  wide_radius: far\n"),
              HasSubstr("options.yaml:2: 'tracking.wide_radius' must be a number, not 'far'"));
  EXPECT_THAT(ErrorOf("tracking:\n  min_matches: 10.5\n"), HasSubstr("a whole number"));
  EXPECT_THAT(ErrorOf("use_points: 3\n"), HasSubstr("true or false"));
  EXPECT_THAT(ErrorOf("mode: orb\n"), HasSubstr("one of pl-vo pl-vo-depth msc-vo, not 'orb'"));
  EXPECT_THAT(ErrorOf("mode: [pl-vo]\n"), HasSubstr("'mode' must be"));
  EXPECT_THAT(ErrorOf("tracking: 5\n"), HasSubstr("'tracking' is a section"));
  EXPECT_THAT(ErrorOf("tracking:\n  wide_radius: .inf\n"), HasSubstr("must be a number"));
}

TEST_F(OptionsFileTest, NumbersOutOfTheirRangeAreErrorsOfTheirLine) {
  EXPECT_THAT(
      ErrorOf("features:\n  points:\n    num_points: 2147483647\n"),
      HasSubstr("options.yaml:3: 'features.points.num_points' must be a whole number from 0 "
                "to 20000, not '2147483647'"));
  EXPECT_THAT(ErrorOf("normals: {grid_step: 1}\n"), HasSubstr("from 8 to 1000, not '1'"));
  EXPECT_THAT(
      ErrorOf("mapping:\n  readout_time: 5\n"),
      HasSubstr("options.yaml:2: 'mapping.readout_time' must be a number from -0.99 to 0.99"));
}

TEST_F(OptionsFileTest, BrokenFilesAreErrors) {
  EXPECT_THAT(ErrorOf("mode: pl-vo\nmode: pl-vo\n"), HasSubstr("options.yaml:2: 'mode' is given"));
  EXPECT_THAT(ErrorOf("mode: pl-vo\n  x: [1\n"), HasSubstr("is no YAML"));
  EXPECT_THAT(ErrorOf("- 1\n- 2\n"), HasSubstr("expected 'name: value' lines"));
}

TEST_F(OptionsFileTest, TakesTheCameraOfOrbSlamSettings) {
  const Configuration configuration = Read(
      "%YAML:1.0\nCamera.fx: 517\nCamera.fy: 516\nCamera.cx: 318\nCamera.cy: 255\n"
      "DepthMapFactor: 5000\nViewer.PointSize:2\nORBextractor.nFeatures: 1000\n");
  EXPECT_EQ(*configuration.camera.fx, 517.0);
  EXPECT_EQ(configuration.camera.origin, Path("options.yaml"));
}

}  // namespace
}  // namespace msc_vo
