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

TEST_F(CommandLogTest, IsNotAppendedToOtherFiles) {
  Synthesize();
  WriteText("options.yaml", "mode: pl-vo\n");
  WriteText("binary", std::string("text\0text", 9));
  const auto refuse = [this](std::vector<std::string> arguments, const std::string& file) {
    const std::string before = ReadFile(Path(file));
    arguments.insert(arguments.end(), {"--log-file", Path(file)});
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, LineNames("error:", "--log-file", Path(file), "give another"));
    EXPECT_EQ(ReadFile(Path(file)), before);
  };
  refuse({"check", Path("room")}, "room/groundtruth.txt");
  refuse({"check", Path("room"), "--config=" + Path("options.yaml")}, "options.yaml");
  refuse({"evaluate", Path("room/groundtruth.txt"), Path("room/groundtruth.txt")},
         "room/groundtruth.txt");
  refuse({"check", Path("room")}, "binary");
  for (int i = 0; i < 2; ++i) {  // a log may be in the folder, and grows there
    EXPECT_EQ(Replay("room_out", {"--log-file", Path("room/log.txt")}).exit_code, 0);
  }
}

}  // namespace
}  // namespace msc_vo
