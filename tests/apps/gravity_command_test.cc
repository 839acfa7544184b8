// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// replay --gravity.

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

using testing::HasSubstr;
using testing::Not;

constexpr char kWarning[] = "the vertical was never measured";

class GravityCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"),
                   {"--scene", "room", "--frames", "30", "--width", "160", "--fps", "5"});
  }
  CommandOutcome Replay() const {
    return RunCommand({"replay", Path("room"), "--quiet", "--gravity", "--output", Path("out")});
  }
  std::string StoredWarnings() const {
    return nlohmann::json::parse(ReadFile(Path("out/summary.json")))["sequence"]["warnings"].dump();
  }
};

TEST_F(GravityCommandTest, WarnsOnlyIfItHasNoEffect) {
  const CommandOutcome outcome = Replay();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, Not(HasSubstr(kWarning)));
  EXPECT_THAT(StoredWarnings(), Not(HasSubstr(kWarning)));

  std::string sparse;  // readings more than a second apart
  const std::vector<TextLine> lines = ReadTextLines(Path("room/accelerometer.txt"));
  for (size_t i = 0; i < lines.size(); ++i) {
    if (i % 300 != 0) continue;
    for (const std::string& field : lines[i].fields) sparse += field + " ";
    sparse += "\n";
  }
  WriteText("room/accelerometer.txt", sparse);
  const CommandOutcome warned = Replay();
  EXPECT_EQ(warned.exit_code, 0) << warned.output;
  EXPECT_THAT(warned.output, LineNames("warning:", "accelerometer.txt", kWarning, "clock"));
  EXPECT_THAT(StoredWarnings(), HasSubstr(kWarning));
}

}  // namespace
}  // namespace msc_vo
