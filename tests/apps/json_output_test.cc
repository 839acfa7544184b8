// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Every command that prints results prints them as JSON on request, alone on standard output.

#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class JsonOutputTest : public TemporaryFolder {
 protected:
  // What the command prints on standard output; progress and messages are elsewhere.
  nlohmann::json Run(std::vector<std::string> arguments, int exit_code = 0) {
    WriteText("stdout", "");
    arguments.emplace_back("--json");
    const CommandOutcome outcome = RunCommand(arguments, Path("stdout"));
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    return nlohmann::json::parse(ReadFile(Path("stdout")));
  }
  nlohmann::json Synthesize() {
    return Run({"synthesize", Path("room"), "--frames", "8", "--width", "160"});
  }
};

TEST_F(JsonOutputTest, Synthesize) {
  const nlohmann::json json = Synthesize();
  EXPECT_EQ(json["frames"], 8);
  EXPECT_EQ(json["scene"], "room");
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["camera"]["width"], 160);
}

TEST_F(JsonOutputTest, Check) {
  Synthesize();
  const nlohmann::json json = Run({"check", Path("room")});
  EXPECT_EQ(json["sequence"], Path("room"));
  EXPECT_EQ(json["format"], "tum");
  EXPECT_EQ(json["errors"], 0);
  EXPECT_EQ(json["findings"][0]["severity"], "ok");
  std::filesystem::remove_all(Path("room/depth"));
  EXPECT_EQ(Run({"check", Path("room")}, 1)["findings"][0]["severity"], "error");
}

TEST_F(JsonOutputTest, Replay) {
  Synthesize();
  const nlohmann::json json = Run({"replay", Path("room"), "--output", Path("out")});
  EXPECT_EQ(json, nlohmann::json::parse(ReadFile(Path("out/summary.json"))));
  EXPECT_EQ(json["frames"]["count"], 8);
}

TEST_F(JsonOutputTest, Benchmark) {
  Synthesize();
  const nlohmann::json json =
      Run({"benchmark", Path("room"), "--modes", "pl-vo", "--output", Path("out")});
  EXPECT_EQ(json, nlohmann::json::parse(ReadFile(Path("out/benchmark.json"))));
  const CommandOutcome outcome = RunCommand({"benchmark", Path("room"), "--json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 2);
}

TEST_F(JsonOutputTest, EvaluateAndSolveWindow) {
  Synthesize();
  Run({"replay", Path("room"), "--output", Path("out")});
  EXPECT_EQ(Run({"evaluate", Path("room/groundtruth.txt"), Path("out/trajectory.txt")})["matched"],
            8);
  const std::string window = std::filesystem::path(MSC_VO_DATA_FOLDER).parent_path().string() +
                             "/tests/data/windows/room.txt";
  EXPECT_TRUE(Run({"solve-window", window}).contains("usable"));
}

}  // namespace
}  // namespace msc_vo
