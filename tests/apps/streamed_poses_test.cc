// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// replay --stdout-poses.

#include <sstream>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

class StreamedPosesTest : public TemporaryFolder {};

// One line per image while the run goes on, and nothing else on standard output.
TEST_F(StreamedPosesTest, PrintsPosesWhileItRuns) {
  EXPECT_EQ(RunCommand({"synthesize", Path("x"), "--frames", "8", "--width", "160"}).exit_code, 0);
  WriteText("poses.txt", "");
  CommandProcess run({"replay", Path("x"), "--output", Path("out"), "--stdout-poses"},
                     Path("poses.txt"));
  EXPECT_EQ(run.Wait(), 0) << run.output();
  std::istringstream poses(ReadFile(Path("poses.txt")));
  int num_lines = 0;
  for (std::string line; std::getline(poses, line); ++num_lines) {
    EXPECT_EQ(SplitFields(line).size(), 16u) << line;
    EXPECT_THAT(line, testing::HasSubstr(" tracked "));
  }
  EXPECT_EQ(num_lines, 8);
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 8u);
  const CommandOutcome both = RunCommand({"replay", Path("x"), "--stdout-poses", "--json"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, Names("--stdout-poses", "--json"));
}

}  // namespace
}  // namespace msc_vo
