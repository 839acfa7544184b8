// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The command on recordings whose driver gives one value to all depths beyond a limit.

#include <filesystem>
#include <functional>
#include <string>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::Not;

constexpr int kFarthest = 12500;  // raw units: 2.5 m

class ClippedDepthCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", "40", "--width", "320"});
    CopyWith("clipped", [](cv::Mat* raw) { cv::min(*raw, kFarthest, *raw); });
  }
  void CopyWith(const std::string& name, const std::function<void(cv::Mat*)>& change) {
    std::filesystem::copy(Path("room"), Path(name), std::filesystem::copy_options::recursive);
    for (const auto& entry : std::filesystem::directory_iterator(Path(name + "/depth"))) {
      cv::Mat depth = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
      change(&depth);
      ASSERT_TRUE(cv::imwrite(entry.path().string(), depth));
    }
  }
  std::string Trajectory(const std::string& name, const std::string& output) {
    RunCommand({"replay", Path(name), "--output", Path(output), "--quiet"});
    return ReadFile(Path(output + "/trajectory.txt"));
  }
};

TEST_F(ClippedDepthCommandTest, IsReportedAndNotUsed) {
  const CommandOutcome check = RunCommand({"check", Path("clipped"), "--json"});
  EXPECT_EQ(check.exit_code, 0);
  int num_found = 0;
  const nlohmann::json report = nlohmann::json::parse(check.output);
  for (const auto& finding : report["findings"]) {
    if (finding["check"] != "depth.clipped") continue;
    ++num_found;
    EXPECT_EQ(finding["severity"], "warning");
    EXPECT_NEAR(finding["value"].get<double>(), 2.5, 1e-9);
    EXPECT_EQ(finding["unit"], "m");
  }
  EXPECT_EQ(num_found, 1);

  const std::string log = Path("log.txt");
  const CommandOutcome replay = RunCommand({"replay", Path("clipped"), "--output", Path("out"),
                                            "--quiet", "--log-file", log, "--no-check"});
  EXPECT_EQ(replay.exit_code, 0);
  EXPECT_THAT(replay.output, LineNames("clipped", "2.500 m", "12500"));
  EXPECT_THAT(ReadFile(log), LineNames("clipped", "2.500 m"));
  EXPECT_THAT(ReadFile(Path("out/summary.json")), Names("clipped", "2.500 m"));

  CopyWith("holes", [](cv::Mat* raw) { raw->setTo(0, *raw >= kFarthest); });
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), Trajectory("holes", "holes_out"));

  ASSERT_EQ(RunCommand({"record", Path("clipped"), Path("copy")}).exit_code, 0);
  EXPECT_THAT(RunCommand({"check", Path("copy")}).output, Not(Names("clipped")));
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), Trajectory("copy", "copy_out"));
}

}  // namespace
}  // namespace msc_vo
