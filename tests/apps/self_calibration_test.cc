// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class SelfCalibrationTest : public TemporaryFolder {
 protected:
  void Synthesize(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> command = {"synthesize", Path(name), "--scene", "room",
                                        "--frames",   "60",       "--fps",   "5",
                                        "--width",    "320",      "--lens",  kLens};
    command.insert(command.end(), more.begin(), more.end());
    const CommandOutcome outcome = RunCommand(command);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
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
  Synthesize("described", {});
  Synthesize("undescribed", {"--untold"});
  const nlohmann::json described = Replay("described");
  const nlohmann::json undescribed = Replay("undescribed");
  const nlohmann::json without = Replay("undescribed", {"--set", "mapping.self_calibration=false"});
  EXPECT_FALSE(described.at("self_calibration").at("corrected").get<bool>());
  const nlohmann::json& k1 = undescribed.at("self_calibration").at("k1");
  EXPECT_EQ(k1.at("verdict"), "corrected");
  EXPECT_NEAR(k1.at("value").get<double>(), -0.3, 0.01);
  EXPECT_LT(Ape(undescribed), 1.5 * Ape(described));
  EXPECT_GT(Ape(without), 3.0 * Ape(described));
}

}  // namespace
}  // namespace msc_vo
