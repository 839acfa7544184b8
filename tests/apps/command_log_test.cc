// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CommandLogTest : public TemporaryFolder {
 protected:
  void Synthesize() {
    RenderSequence(Path("room"), {"--scene", "room", "--frames", "20", "--width", "160"});
  }
  CommandOutcome Replay(const std::string& output, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--quiet", "--output",
                                          Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
};

TEST_F(CommandLogTest, WritesTheEventsOfARunToAFile) {
  Synthesize();
  EXPECT_EQ(Replay("silent", {}).output, "");
  const CommandOutcome logged =
      Replay("logged", {"--log-file", Path("log.txt"), "--log-level", "debug"});
  EXPECT_EQ(logged.exit_code, 0);
  EXPECT_EQ(logged.output, "");
  EXPECT_THAT(ReadFile(Path("log.txt")),
              AllOf(LineNames("[info]", Path("room"), "20"), Names("camera.txt", "msc-vo"),
                    LineNames("[debug]", "frame 0", "keyframe"), Names("tracked", "noise"),
                    LineNames("[info]", Path("logged"))));
  EXPECT_EQ(ReadFile(Path("logged/trajectory.txt")), ReadFile(Path("silent/trajectory.txt")));
}

TEST_F(CommandLogTest, WritesToStandardErrorWithoutAFile) {
  Synthesize();
  const CommandOutcome outcome = Replay("out", {"--log-level", "info"});
  EXPECT_THAT(outcome.output, AllOf(LineNames("[info]", "frame 0"),
                                    LineNames("[info]", Path("out")), Not(HasSubstr("[debug]"))));
}

TEST_F(CommandLogTest, ContainsWarningsAndErrorsOfTheCommand) {
  const CommandOutcome outcome = RunCommand({"--log-file", Path("log.txt"), "replay",
                                             Path("nowhere"), "--mode", "pl-vo", "--no-manhattan"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(ReadFile(Path("log.txt")), AllOf(LineNames("[warning]", "mapping.axes.enabled=false"),
                                               LineNames("[error]", Path("nowhere"))));
}

TEST_F(CommandLogTest, RefusesAFileThatCannotBeWritten) {
  WriteText("file", "");
  const CommandOutcome outcome =
      RunCommand({"replay", "x", "--log-file", Path("file") + "/log.txt"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "--log-file", Path("file") + "/log.txt"));
  EXPECT_EQ(RunCommand({"replay", "x", "--log-level", "loud"}).exit_code, 2);
}

}  // namespace
}  // namespace msc_vo
