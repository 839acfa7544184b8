// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/options_file.h"

#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/config/camera_options.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// What the documentation of an option says.
struct OptionTexts {
  std::string value, valid, help, when;
};

OptionTexts TextsOf(const std::string& path) {
  Configuration configuration;
  const std::vector<Option> options = ListOptions(&configuration);
  const Option& option = *FindByPath(options, path);
  return {FormatOption(option), FormatValidValues(option), option.help, option.when_to_change};
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

TEST_F(OptionsFileTest, KeepsOptionsThatTheFileDoesNotContain) {
  const Configuration configuration = Read(
      "# mine\nmode: pl-vo\ncamera:\n  fx: 500.5\n  width: 320\n  preset: tum-fr1\n"
      "use_points: off\ntracking:\n  wide_radius: 80\n  point_matcher: {max_distance: 70}\n"
      "  pose:\n    consensus: {enabled: false}\nmapping:\n");
  EXPECT_EQ(configuration.odometry.mode, Mode::kPlVo);
  EXPECT_FALSE(configuration.odometry.use_points);
  EXPECT_EQ(*configuration.camera.fx, 500.5);
  EXPECT_EQ(*configuration.camera.width, 320);
  EXPECT_EQ(configuration.camera.preset, "tum-fr1");
  EXPECT_FALSE(configuration.camera.fy.has_value());
  EXPECT_EQ(configuration.odometry.tracking.wide_radius, 80.0);
  EXPECT_EQ(configuration.odometry.tracking.matchers.point_matcher.max_distance, 70);
  EXPECT_FALSE(configuration.odometry.tracking.pose.consensus.enabled);
  EXPECT_EQ(configuration.odometry.tracking.prediction_radius, TrackerOptions().prediction_radius);
}

TEST_F(OptionsFileTest, ReadsUtf8WithAByteOrderMarkAndNamesUtf16) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(*Read(mark + "camera: {fx: 500}\n").camera.fx, 500.0);
  const std::string orb_slam =
      "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 1\nCamera.cy: 1\nDepthMapFactor: 1000\n";
  EXPECT_EQ(*Read(mark + orb_slam).camera.fx, 500.0);
  WriteText("camera.txt", mark + "500 500 320 240 640 480 1000\n");
  Configuration configuration;
  ReadCamera(Path("camera.txt"), &configuration);
  EXPECT_EQ(*configuration.camera.fx, 500.0);
  for (const std::string& text : {std::string("camera: {fx: 500}\n"), orb_slam}) {
    std::string wide = "\xFF\xFE";
    for (const char c : text) wide += std::string(1, c) + '\0';
    EXPECT_THAT(ErrorOf(wide), Names("options.yaml", "UTF-16", "UTF-8"));
    EXPECT_THAT(MessageOf([&] { ReadCamera(Path("options.yaml"), &configuration); }),
                Names("options.yaml", "UTF-16", "UTF-8"));
  }
}

TEST_F(OptionsFileTest, ReadsLists) {
  const Configuration configuration =
      Read("camera:\n  depth_camera: {fx: 585, translation: [-0.025, 0, 1e-3]}\n");
  EXPECT_EQ(*configuration.camera.depth_camera.fx, 585.0);
  EXPECT_EQ(configuration.camera.depth_camera.translation,
            std::vector<double>({-0.025, 0.0, 0.001}));
  EXPECT_TRUE(configuration.camera.depth_camera.rotation.empty());
  for (const char* value : {"1", "[1, 2]", "[1, 2, x]", "[1, [2], 3]"}) {
    EXPECT_THAT(MessageOf([&] {
                  Read("camera:\n  depth_camera:\n    translation: " + std::string(value) + "\n");
                }),
                Names("options.yaml:3", "camera.depth_camera.translation", "3"))
        << value;
  }
}

TEST_F(OptionsFileTest, AcceptsAnEmptyFile) {
  EXPECT_TRUE(ChangedOptions(Read("")).empty());
  EXPECT_TRUE(ChangedOptions(Read("# comment\n")).empty());
}

TEST_F(OptionsFileTest, ReadsBackEveryOption) {
  Configuration configuration;
  // A value for each option that differs from its default.
  for (const Option& option : ListOptions(&configuration)) {
    const std::string before = FormatOption(option);
    bool changed = false;
    for (const char* text :
         {"true", "false", "17", "7", "0.12345678901234567", "pl-vo", "tof", "end-points", "lsd",
          "edge-drawing", "ceres", "never", "[1, 2.5, 3]", "[0, 0, 1, 0]"}) {
      std::string expected;
      changed = changed || (text != before && SetOption(option, text, &expected));
    }
    EXPECT_TRUE(changed) << option.path;
    EXPECT_NE(FormatOption(option), before) << option.path;
  }
  const std::string text = FormatConfiguration(configuration, OptionSelection::kAll);
  EXPECT_EQ(FormatConfiguration(Read(text), OptionSelection::kAll), text);
}

TEST_F(OptionsFileTest, ReadsBackAnyText) {
  for (const std::string text :
       {"tum-fr1", "a: b", "# no comment", "null", "-", "two\nlines", "\"\\'", "\x01\xff"}) {
    Configuration configuration;
    configuration.camera.preset = text;
    EXPECT_EQ(Read(FormatConfiguration(configuration, OptionSelection::kAll)).camera.preset, text);
  }
}

TEST_F(OptionsFileTest, WritesBasicOptionsOnlyUnlessAllAreSelected) {
  const std::string basic = FormatConfiguration(Configuration(), OptionSelection::kBasic);
  const OptionTexts radius = TextsOf("tracking.prediction_radius");
  EXPECT_THAT(basic, AllOf(HasSubstr("\n  prediction_radius: " + radius.value + " "),
                           HasSubstr("\n  # fx: "), Names(radius.help, radius.valid, radius.when)));
  EXPECT_THAT(basic, Not(HasSubstr("wide_radius")));
  EXPECT_TRUE(ChangedOptions(Read(basic)).empty());
  EXPECT_THAT(FormatConfiguration(Configuration(), OptionSelection::kAll),
              AllOf(HasSubstr("prediction_radius"), HasSubstr("wide_radius")));
}

TEST_F(OptionsFileTest, WritesTablesInMarkdown) {
  const std::string basic = FormatOptionsMarkdown(OptionSelection::kBasic);
  const OptionTexts radius = TextsOf("tracking.prediction_radius");
  EXPECT_THAT(basic, HasSubstr("\n| `tracking.prediction_radius` | `" + radius.value + "` | " +
                               radius.valid + " | " + radius.help + " | " + radius.when));
  EXPECT_THAT(basic, Not(HasSubstr("wide_radius")));
  const std::string all = FormatOptionsMarkdown(OptionSelection::kAll);
  const OptionTexts wide = TextsOf("tracking.wide_radius");
  EXPECT_EQ(all.rfind(basic, 0), 0u);
  EXPECT_THAT(all, AllOf(HasSubstr("\n### tracking\n"),
                         HasSubstr("\n| `tracking.wide_radius` | `" + wide.value + "` | " +
                                   wide.valid + " |"),
                         HasSubstr("\n### mapping.window\n")));
}

TEST_F(OptionsFileTest, SuggestsASimilarNameForAnUnknownOne) {
  EXPECT_THAT(ErrorOf("\ntracking:\n  wide_raduis: 80\n"),
              Names("options.yaml:3", "tracking.wide_raduis", "tracking.wide_radius"));
  EXPECT_THAT(ErrorOf("max_lines: 80\n"), Names("options.yaml:1", "features.lines.max_lines"));
  EXPECT_THAT(ErrorOf("xyzzy: 80\n"), Names("options.yaml:1", "xyzzy", "--print-config --all"));
}

TEST_F(OptionsFileTest, RefusesWrongTypes) {
  EXPECT_THAT(ErrorOf("tracking:\n  wide_radius: far\n"),
              Names("options.yaml:2", "tracking.wide_radius", "0.1", "1000", "pixels", "far"));
  EXPECT_THAT(ErrorOf("tracking:\n  min_matches: 10.5\n"),
              Names("options.yaml:2", "tracking.min_matches", "whole number", "'10.5'"));
  EXPECT_THAT(ErrorOf("use_points: 3\n"),
              Names("options.yaml:1", "use_points", "true", "false", "'3'"));
  EXPECT_THAT(ErrorOf("mode: orb\n"),
              Names("options.yaml:1", "mode", "pl-vo", "pl-vo-depth", "msc-vo", "orb"));
  EXPECT_THAT(
      ErrorOf("mapping:\n  window:\n    solver: ceres-dense-schur\n"),
      Names("options.yaml:3", "block-schur", "ceres", "ceres-suite-sparse", "ceres-dense-schur"));
  EXPECT_THAT(ErrorOf("mode: [pl-vo]\n"), Names("options.yaml:1", "mode", "value"));
  EXPECT_THAT(ErrorOf("tracking: 5\n"), Names("options.yaml:1", "tracking", "section"));
  EXPECT_THAT(ErrorOf("tracking:\n  wide_radius: .inf\n"),
              Names("options.yaml:2", "tracking.wide_radius", "number", ".inf"));
}

TEST_F(OptionsFileTest, RefusesNumbersOutOfRange) {
  EXPECT_THAT(ErrorOf("features:\n  points:\n    num_points: 2147483647\n"),
              Names("options.yaml:3", "features.points.num_points", "whole number", "0", "20000",
                    "'2147483647'"));
  EXPECT_THAT(ErrorOf("tracking: {wide_radius: 0}\n"),
              Names("options.yaml:1", "tracking.wide_radius", "0.1", "1000", "'0'"));
  EXPECT_THAT(ErrorOf("mapping:\n  readout_time: 5\n"),
              Names("options.yaml:2", "mapping.readout_time", "-0.99", "0.99", "'5'"));
}

TEST_F(OptionsFileTest, RefusesMalformedFiles) {
  EXPECT_THAT(ErrorOf("mode: pl-vo\nmode: pl-vo\n"), Names("options.yaml:2", "mode", "twice"));
  EXPECT_THAT(ErrorOf("mode: pl-vo\n  x: [1\n"), Names("options.yaml:2", "malformed"));
  EXPECT_THAT(ErrorOf("- 1\n- 2\n"), Names("options.yaml:1", "name: value"));
  EXPECT_THAT(ErrorOf("mode: pl-vo\n---\nfoo: 1\n"), Names("options.yaml:2", "second document"));
  EXPECT_THAT(ErrorOf("--- # one\nmode: pl-vo\n...\nfoo: 1\n"), Names("options.yaml:3"));
  EXPECT_EQ(ErrorOf("mode: pl-vo\n---\n# end\n"), "");
}

TEST_F(OptionsFileTest, RefusesTooLargeAndEndlessFiles) {
  WriteText("large.yaml", "");
  std::filesystem::resize_file(Path("large.yaml"), kMaxOptionsBytes + 1);
  Configuration configuration;
  EXPECT_THAT(MessageOf([&] { ReadConfiguration(Path("large.yaml"), &configuration); }),
              Names("large.yaml", "MiB"));
  EXPECT_THAT(MessageOf([&] { ReadConfiguration("/dev/zero", &configuration); }),
              Names("/dev/zero", "device"));
}

TEST_F(OptionsFileTest, ReadsTheCameraOfOrbSlamSettings) {
  const Configuration configuration = Read(
      "%YAML:1.0\nCamera.fx: 517\nCamera.fy: 516\nCamera.cx: 318\nCamera.cy: 255\n"
      "DepthMapFactor: 5000\nViewer.PointSize:2\nORBextractor.nFeatures: 1000\n");
  EXPECT_EQ(*configuration.camera.fx, 517.0);
  EXPECT_EQ(configuration.camera.origin, Path("options.yaml"));
  const std::string camera =
      "Camera.fx: 517\nCamera.fy: 516\nCamera.cx: 318\nCamera.cy: 255\nDepthMapFactor: 5000\n";
  EXPECT_THAT(ErrorOf(camera + "Camera.fx: 481\n"), Names("options.yaml:6", "Camera.fx", "twice"));
  // Entries of matrices have the same names.
  EXPECT_EQ(*Read(camera + "Tbc: !!opencv-matrix\n  rows: 4\nTlr: !!opencv-matrix\n  rows: 3\n")
                 .camera.fx,
            517.0);
}

}  // namespace
}  // namespace msc_vo
