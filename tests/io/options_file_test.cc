// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/io/options_file.h"

#include <set>

#include "tests/io/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
                             "lsd", "edge-drawing"}) {
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
