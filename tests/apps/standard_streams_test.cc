// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Standard output that cannot be written is an error, a closed pipe is not.

#include <csignal>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class StandardStreamsTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", "3", "--width", "160"});
  }
};

TEST_F(StandardStreamsTest, FailsIfStandardOutputCannotBeWritten) {
  const std::string truth = Path("room/groundtruth.txt");
  const std::vector<std::vector<std::string>> commands = {
      {"--help"},
      {"--version"},
      {"replay", "--print-config"},
      {"evaluate", truth, truth},
      {"evaluate", truth, truth, "--json"},
      {"check", Path("room")},
      {"replay", Path("room"), "--output", Path("out")},
      {"benchmark", Path("room"), "--modes", "pl-vo", "--output", Path("benchmark")}};
  for (const std::vector<std::string>& arguments : commands) {
    const CommandOutcome outcome = RunCommand(arguments, "/dev/full");
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, LineNames("error:", "standard output"));
  }
  EXPECT_TRUE(std::filesystem::exists(Path("out/summary.json")));
}

TEST_F(StandardStreamsTest, FinishesTheRunAfterAClosedPipe) {
  CommandProcess replay({"replay", Path("room"), "--output", Path("out")});
  replay.CloseOutput();
  EXPECT_EQ(replay.Wait(), -SIGPIPE);
  EXPECT_TRUE(std::filesystem::exists(Path("out/report.html")));
}

}  // namespace
}  // namespace msc_vo
