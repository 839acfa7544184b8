// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Depth sensors of `synthesize` and of `replay`.

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

class DepthSensorCommandTest : public TemporaryFolder {
 protected:
  void Synthesize(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", Path(name), "--frames",
                                          "3",          "--width",  "320"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandOutcome outcome = RunCommand(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  std::string SensorOf(const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {
        "replay",  Path(name),   "--output",         Path(name + "/out"),
        "--quiet", "--log-file", Path(name + "/log")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return nlohmann::json::parse(ReadFile(Path(name + "/out/summary.json")))["depth_sensor"];
  }
};

TEST_F(DepthSensorCommandTest, ChoosesTheSensorThatWasRendered) {
  for (const std::string sensor : {"tof", "stereo", "lidar"}) {
    // A scene whose first image has near and far surfaces.
    Synthesize(sensor, {"--depth-sensor", sensor, "--scene", "corridor"});
    EXPECT_EQ(SensorOf(sensor), sensor);
    EXPECT_THAT(LineNaming("depth sensor", ReadFile(Path(sensor + "/log"))),
                Names(sensor, "chosen"));
    EXPECT_THAT(ReadFile(Path(sensor + "/out/report.html")), HasSubstr(sensor + " (chosen"));
  }
  Synthesize("exact", {});
  EXPECT_EQ(SensorOf("exact"), "structured-light");
}

TEST_F(DepthSensorCommandTest, TakesTheGivenSensor) {
  Synthesize("exact", {});
  EXPECT_EQ(SensorOf("exact", {"--depth-sensor", "tof"}), "tof");
  EXPECT_THAT(ReadFile(Path("exact/log")), Names("tof", "given"));
}

TEST_F(DepthSensorCommandTest, HasTheNamesOfReplayAndOlderOnes) {
  const auto depth_of = [this](const std::string& option, const std::string& sensor) {
    Synthesize(option + sensor, {"--" + option, sensor});
    const std::string truth = ReadFile(Path(option + sensor + "/truth.json"));
    return nlohmann::json::parse(truth)["depth_sensor"].get<std::string>() +
           ReadFile(Path(option + sensor + "/depth/1.000000.png"));
  };
  const std::string structured_light = depth_of("depth-sensor", "structured-light");
  EXPECT_THAT(structured_light, testing::StartsWith("structured-light"));
  EXPECT_EQ(depth_of("sensor", "kinect"), structured_light);
  EXPECT_EQ(depth_of("noise", "kinect"), structured_light);
  const std::string exact = depth_of("depth-sensor", "exact");
  EXPECT_THAT(exact, testing::StartsWith("exact"));
  EXPECT_EQ(depth_of("noise", "none"), exact);
}

TEST_F(DepthSensorCommandTest, RefusesUnknownSensorsAndTwoOfThem) {
  CommandOutcome outcome = RunCommand({"synthesize", Path("a"), "--sensor", "radar"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, Names("'radar'", "exact"));
  outcome = RunCommand({"synthesize", Path("a"), "--sensor", "tof", "--noise", "kinect"});
  EXPECT_EQ(outcome.exit_code, 2);
  outcome = RunCommand({"replay", Path("a"), "--depth-sensor", "radar"});
  EXPECT_EQ(outcome.exit_code, 2);
}

}  // namespace
}  // namespace msc_vo
