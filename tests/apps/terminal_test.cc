// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Output on a terminal: script(1) runs the command on one.

#include <array>
#include <cstdio>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class TerminalTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    if (std::system("command -v script > /dev/null") != 0)
      GTEST_SKIP() << "script is not installed";
  }
  std::string OnTerminal(const std::string& environment, const std::string& arguments) {
    const std::string command = "env -u NO_COLOR TERM=xterm " + environment +
                                " script -qec '" MSC_VO_COMMAND " " + arguments +
                                "' /dev/null < /dev/null 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    std::string output;
    std::array<char, 4096> buffer;
    while (const size_t count = fread(buffer.data(), 1, buffer.size(), pipe)) {
      output.append(buffer.data(), count);
    }
    pclose(pipe);
    return output;
  }
};

TEST_F(TerminalTest, ColoursMessagesUnlessToldOtherwise) {
  const std::string arguments = "evaluate " + Path("no") + " " + Path("no");
  EXPECT_THAT(OnTerminal("", arguments), HasSubstr("msc_vo: \x1b[31merror:\x1b[0m "));
  EXPECT_THAT(OnTerminal("NO_COLOR=1", arguments),
              AllOf(Names("msc_vo: error:"), Not(HasSubstr("\x1b["))));
  EXPECT_THAT(OnTerminal("TERM=dumb", arguments), Not(HasSubstr("\x1b[")));
}

TEST_F(TerminalTest, UpdatesOneLineOfProgress) {
  const std::string arguments = "synthesize " + Path("room") + " --frames 5 --width 64";
  const std::string output = OnTerminal("", arguments);
  EXPECT_THAT(output, AllOf(HasSubstr("\r["), HasSubstr("5/5")));
  EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1);
}

}  // namespace
}  // namespace msc_vo
