// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class SelfCalibrationTest : public TemporaryFolder {
 protected:
  void Synthesize(const std::string& name, int num_frames, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "--scene", "room", "--fps", "5", "--width", "320", "--frames", std::to_string(num_frames)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    RenderSequence(Path(name), arguments);
  }
  nlohmann::json Replay(const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> command = {"replay", Path(name), "--output", Path("out")};
    command.insert(command.end(), more.begin(), more.end());
    const CommandOutcome outcome = RunCommand(command);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  }
  static double Ape(const nlohmann::json& summary) { return summary.at("error").at("ape_rmse"); }

  static constexpr char kLens[] = "radial-tangential:-0.3,0.1,0,0,0";
};

TEST_F(SelfCalibrationTest, CorrectsAnUnknownLens) {
  Synthesize("described", 60, {"--lens", kLens});
  Synthesize("undescribed", 60, {"--lens", kLens, "--untold"});
  const nlohmann::json described = Replay("described");
  EXPECT_FALSE(described.at("self_calibration").at("corrected").get<bool>());
  const nlohmann::json without = Replay("undescribed", {"--set", "mapping.self_calibration=false"});
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--no-planes"}}) {
    const nlohmann::json undescribed = Replay("undescribed", more);
    const nlohmann::json& k1 = undescribed.at("self_calibration").at("k1");
    EXPECT_EQ(k1.at("verdict"), "corrected");
    EXPECT_NEAR(k1.at("value").get<double>(), -0.3, 0.01);
    EXPECT_LT(Ape(undescribed), 0.5 * Ape(without));
  }
  // Planes gain more from an exact calibration than from one that is found.
  const std::vector<std::string> options = {"--no-planes", "--set",
                                            "features.points.num_points=1000"};
  EXPECT_LT(Ape(Replay("undescribed", options)), 1.5 * Ape(Replay("described", options)));
  EXPECT_GT(Ape(without), 3.0 * Ape(described));
}

TEST_F(SelfCalibrationTest, CorrectsAWrongFocalLength) {
  // An error of 3 % is found in so short a sequence with some numbers of points only.
  Synthesize("wrong", 60, {"--focal-length-error", "5"});
  const nlohmann::json truth = nlohmann::json::parse(ReadFile(Path("wrong/truth.json")));
  const nlohmann::json fx = Replay("wrong").at("self_calibration").at("fx");
  EXPECT_EQ(fx.at("verdict"), "corrected");
  EXPECT_NEAR(fx.at("value").get<double>(), truth["camera"]["fx"].get<double>(),
              0.01 * truth["camera"]["fx"].get<double>());
}

TEST_F(SelfCalibrationTest, RegistersTheImagesOfADepthCameraThatNobodyTold) {
  // A focal length of 292.5 px instead of 262.5.
  const std::vector<std::string> rig = {"--rig", "292.5,0.025,0,0.5"};
  Synthesize("told", 120, rig);
  Synthesize("untold", 120, {rig[0], rig[1], "--untold"});
  const nlohmann::json told = Replay("told");
  const nlohmann::json untold = Replay("untold");
  const nlohmann::json without = Replay("untold", {"--set", "mapping.self_calibration=false"});
  EXPECT_FALSE(told.at("self_calibration").at("corrected").get<bool>());
  const nlohmann::json& values = untold.at("self_calibration");
  EXPECT_EQ(values.at("fx").at("verdict"), "kept");
  EXPECT_EQ(values.at("depth_fx").at("verdict"), "corrected");
  for (const auto& [name, truth] :
       {std::pair("depth_fx", 292.5), std::pair("depth_roll", 0.5), std::pair("depth_x", 25.0)}) {
    const double value = values.at(name).at("value");
    EXPECT_NEAR(value, truth, 3.0 * values.at(name).at("sigma").get<double>()) << name;
  }
  EXPECT_LT(Ape(untold), 0.5 * Ape(without));
}

}  // namespace
}  // namespace msc_vo
