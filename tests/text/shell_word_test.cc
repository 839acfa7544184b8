// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/shell_word.h"

#include <array>
#include <cstdio>
#include <memory>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(ShellWordTest, IsOneArgumentOfAShell) {
  for (const std::string text : {"", "a b", "it's", "$HOME", "`ls`", "a\"b", "~", "*", "a;b|c&d",
                                 "(x)", "#", "a\\b", "!x", "two\nlines", "-v", "\xff"}) {
    const std::string command = "printf '%s|' " + ShellWord(text);
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::array<char, 64> output;
    const size_t count = fread(output.data(), 1, output.size(), pipe.get());
    EXPECT_EQ(std::string(output.data(), count), text + "|");
  }
}

TEST(ShellWordTest, LeavesPlainTextAsItIs) {
  for (const std::string text : {"out/room_1", "--set", "mapping.latency=0.05", "a:b,c@d%e+f"}) {
    EXPECT_EQ(ShellWord(text), text);
  }
}

}  // namespace
}  // namespace msc_vo
