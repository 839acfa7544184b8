// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Results of `calibrate`: table, JSON, files.

#include <cmath>
#include <csignal>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/apps/sample_room.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CalibrateCommandTest : public TemporaryFolder {
 protected:
  // The line of the table that begins with a name; empty: there is none.
  static std::string LineOf(const std::string& table, const std::string& name) {
    const size_t begin = table.find("\n" + name);
    if (begin == std::string::npos) return "";
    return table.substr(begin + 1, table.find('\n', begin + 1) - begin - 1);
  }
};

TEST_F(CalibrateCommandTest, KeepsTheCalibrationOfTheSample) {
  const std::string camera = Path("camera.yaml");
  const CommandOutcome outcome = RunCommand({"calibrate", kRoom, "--json", "--output", camera});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json json = nlohmann::json::parse(outcome.output);
  EXPECT_TRUE(json["problem"].is_null());
  bool has_estimate = false;
  for (const auto& [key, parameter] : json["parameters"].items()) {
    const bool is_known = !parameter["estimated"].is_null();
    has_estimate |= is_known && parameter["estimated"] != parameter["given"];
    EXPECT_EQ(is_known, !parameter["sigma"].is_null()) << key;
    EXPECT_EQ(parameter["given"], parameter["used"]) << key;
    if (is_known) {
      const double given = parameter["given"].is_null() ? 0.0 : parameter["given"].get<double>();
      EXPECT_LT(std::abs(parameter["estimated"].get<double>() - given),
                4.0 * parameter["sigma"].get<double>())
          << key;
    }
    const std::string verdict = parameter["verdict"];
    if (key == "depth_offset" || key == "depth_radial_error") {
      EXPECT_EQ(verdict, is_known ? "not corrected" : "not observable") << key;
      EXPECT_TRUE(parameter["log_odds"].is_null()) << key;
    } else if (key == "readout_time") {
      EXPECT_EQ(verdict, "not found");
    } else {
      EXPECT_EQ(verdict, is_known ? "kept" : "kept: not observable") << key;
      EXPECT_LT(parameter["log_odds"], 0.0) << key;
    }
  }
  EXPECT_TRUE(has_estimate);
  EXPECT_THAT(ReadFile(camera), AllOf(HasSubstr("\n  fx: 525\n"), Not(HasSubstr("readout_time"))));
  for (const char* option : {"--config", "--camera-file"}) {
    const CommandOutcome again = RunCommand({"check", kRoom, option, camera});
    EXPECT_EQ(again.exit_code, 0) << again.output;
  }
}

TEST_F(CalibrateCommandTest, ListsTheCameraOfRegisteredDepthOnce) {
  const CommandOutcome outcome = RunCommand({"calibrate", kRoom});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string fx = LineOf(outcome.output, "fx, px");
  EXPECT_THAT(fx, HasSubstr("  525.0000 "));
  EXPECT_THAT(LineOf(outcome.output, "readout time, s"), Names("not found"));
  EXPECT_EQ(LineOf(outcome.output, "depth camera fx"), "");
  EXPECT_NE(LineOf(outcome.output, "depth camera roll"), "");
  EXPECT_THAT(outcome.output, LineNames("round 1", "room"));
}

TEST_F(CalibrateCommandTest, KeepsTheReadoutTime) {
  std::filesystem::copy(kRoom, Path("room"), std::filesystem::copy_options::recursive);
  WriteText("room/camera.txt", "525 525 319.5 239.5 640 480 5000\nreadout_time 0.001\n");
  const std::string camera = Path("camera.yaml");
  CommandOutcome outcome = RunCommand(
      {"calibrate", Path("room"), "--json", "--output", camera, "--plot", Path("residuals.svg")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json row = nlohmann::json::parse(outcome.output)["parameters"]["readout_time"];
  EXPECT_EQ(row["given"], 0.001);
  EXPECT_EQ(row["used"], 0.001);
  EXPECT_EQ(row["verdict"], "kept");
  EXPECT_THAT(ReadFile(camera), HasSubstr("\nmapping:\n  readout_time: 0.001\n"));
  // The file of the camera replaces that of the sequence, with the same numbers.
  const auto replay = [this](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--quiet", "--output",
                                          Path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandOutcome replayed = RunCommand(arguments);
    EXPECT_EQ(replayed.exit_code, 0) << replayed.output;
    return ReadFile(Path(name + "/trajectory.txt"));
  };
  EXPECT_EQ(replay("given", {}), replay("used", {"--camera-file", camera}));
  outcome = RunCommand({"calibrate", Path("room"), kRoom});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("mapping.readout_time", "0.001"));
}

TEST_F(CalibrateCommandTest, SaysThatNoSuchLensFits) {
  RenderSequence(Path("wide"),
                 {"--scene", "slanted", "--frames", "20", "--fps", "5", "--width", "240",
                  "--focal-length", "120", "--lens=fisheye:-0.15,0.02,0,0", "--untold"});
  const std::string camera = Path("camera.yaml");
  // With other numbers of points, the best lens may just not fold over.
  std::vector<std::string> arguments = {
      "calibrate", Path("wide"), "--output", camera, "--set", "features.points.num_points=1000"};
  CommandOutcome outcome = RunCommand(arguments);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(LineOf(outcome.output, "k1"), Names("kept"));
  EXPECT_THAT(outcome.output,
              Names("error:", "radial-tangential", "camera.lens", "fisheye", "k1", "k4"));
  EXPECT_FALSE(HasEntry(camera));
  // As the message says.
  for (const char* setting :
       {"camera.lens=fisheye", "camera.k1=0", "camera.k2=0", "camera.k3=0", "camera.k4=0"}) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  outcome = RunCommand(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(ReadFile(camera), AllOf(HasSubstr("  k1: -0.1"), HasSubstr("  lens: fisheye\n")));
}

TEST_F(CalibrateCommandTest, PlotsTheResiduals) {
  const std::string page = Path("residuals.html");
  const CommandOutcome outcome = RunCommand({"calibrate", kRoom, "--json", "--plot", page});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json residuals = nlohmann::json::parse(outcome.output)["residuals"];
  EXPECT_GT(residuals["given"]["points"], 1000);
  EXPECT_TRUE(residuals["estimated"].is_null());
  EXPECT_THAT(ReadFile(page), AllOf(HasSubstr(">given<"), HasSubstr(", %<"), Names("pairs")));
  const CommandOutcome refused = RunCommand({"calibrate", kRoom, "--plot", Path("residuals.txt")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, Names("--plot", ".html", ".svg"));
}

TEST_F(CalibrateCommandTest, PrintsNothingIfQuiet) {
  const std::string camera = Path("camera.yaml");
  const CommandOutcome outcome = RunCommand({"calibrate", kRoom, "--quiet", "--output", camera});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "");
  EXPECT_TRUE(HasEntry(camera));
}

TEST_F(CalibrateCommandTest, ReturnsTheCodeOfAnInterruption) {
  const std::string camera = Path("camera.yaml");
  // Paced, so that the run is not over before the signal.
  CommandProcess calibrate({"calibrate", kRoom, "--set", "realtime=true", "--output", camera});
  ASSERT_TRUE(calibrate.WaitForOutput("round 1")) << calibrate.output();
  calibrate.Signal(SIGINT);
  EXPECT_EQ(calibrate.Wait(), 130) << calibrate.output();
  EXPECT_THAT(calibrate.output(), Names("interrupted"));
  EXPECT_FALSE(HasEntry(camera));
}

TEST_F(CalibrateCommandTest, ReturnsTheCodeOfFailedTracking) {
  RenderSequence(Path("room"), {"--frames", "30", "--width", "160"});
  for (const std::string& path : ListFolder(Path("room/rgb"))) {  // black images
    WriteImage("room/rgb/" + std::filesystem::path(path).filename().string(), CV_8UC3, 0, 160, 120);
  }
  const CommandOutcome outcome =
      RunCommand({"calibrate", Path("room"), "--output", Path("camera.yaml")});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_THAT(outcome.output, Names("nothing"));
  EXPECT_FALSE(HasEntry(Path("camera.yaml")));
}

}  // namespace
}  // namespace msc_vo
