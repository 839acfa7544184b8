// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

const std::string kRoom = std::string(MSC_VO_DATA_FOLDER) + "/room";

class CalibrateCommandTest : public TemporaryFolder {};

TEST_F(CalibrateCommandTest, KeepsTheCalibrationOfTheSample) {
  const std::string camera = Path("camera.yaml");
  const CommandOutcome outcome = RunCommand({"calibrate", kRoom, "--json", "--output", camera});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json json = nlohmann::json::parse(outcome.output);
  for (const auto& [key, parameter] : json["parameters"].items()) {
    if (key == "depth_offset" || key == "depth_radial_error") {
      EXPECT_THAT(parameter["verdict"], AnyOf("not corrected", "not observable")) << key;
      EXPECT_TRUE(parameter["log_odds"].is_null()) << key;
      EXPECT_LT(std::abs(parameter["estimated"].get<double>()),
                4.0 * parameter["sigma"].get<double>())
          << key;
      continue;
    }
    EXPECT_THAT(parameter["verdict"].get<std::string>(), HasSubstr("kept"));
    EXPECT_EQ(parameter["given"], parameter["estimated"]);
  }
  const CommandOutcome again = RunCommand({"check", kRoom, "--config", camera});
  EXPECT_EQ(again.exit_code, 0) << again.output;
}

TEST_F(CalibrateCommandTest, PlotsTheResiduals) {
  const std::string page = Path("residuals.html");
  const CommandOutcome outcome =
      RunCommand({"calibrate", kRoom, "--max-frames", "60", "--json", "--plot", page});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json residuals = nlohmann::json::parse(outcome.output)["residuals"];
  EXPECT_GT(residuals["given"]["points"], 1000);
  EXPECT_TRUE(residuals["estimated"].is_null());
  EXPECT_THAT(ReadFile(page), AllOf(HasSubstr(">given<"), HasSubstr("pairs of images"),
                                    HasSubstr(">median error of depth, %<")));
  const CommandOutcome refused = RunCommand({"calibrate", kRoom, "--plot", Path("residuals.txt")});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("must end in .html or .svg"));
}

TEST_F(CalibrateCommandTest, RefusesSequencesOfDifferentCameras) {
  const std::string other = Path("other");
  MakeFolder(other);
  const CommandOutcome outcome =
      RunCommand({"synthesize", other, "--frames", "2", "--width", "160"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const CommandOutcome refused = RunCommand({"calibrate", kRoom, other});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output, HasSubstr("calibrate the sequences of each camera together"));
}

TEST_F(CalibrateCommandTest, DoesNotOverwriteItsInput) {
  const std::string sequence = Path("sequence");
  ASSERT_EQ(RunCommand({"synthesize", sequence, "--frames", "2", "--width", "160"}).exit_code, 0);
  const std::string camera = sequence + "/camera.txt";
  const std::string before = ReadFile(camera);
  const CommandOutcome outcome = RunCommand({"calibrate", sequence, "--output", camera});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_EQ(ReadFile(camera), before);
  const std::string page = sequence + "/residuals.html";
  EXPECT_EQ(RunCommand({"calibrate", sequence, "--plot", page}).exit_code, 1);
  EXPECT_FALSE(HasEntry(page));
}

}  // namespace
}  // namespace msc_vo
