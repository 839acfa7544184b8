// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/message_matchers.h"

#include <string>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::Not;

TEST(Names, NeedsEveryTokenInAnyOrder) {
  const std::string message = "list.txt:12: scale = 0.5 (--scale) is too small";
  EXPECT_THAT(message, Names("--scale", "list.txt:12", "0.5"));
  EXPECT_THAT(message, Not(Names("--scale", "list.txt:13")));
  testing::StringMatchResultListener listener;
  EXPECT_FALSE(Names("scale", "--size", "7").MatchAndExplain(message, listener.stream()));
  EXPECT_EQ(listener.str(), "which does not name --size, 7");
}

TEST(Names, FindsNoPartsOfNumbers) {
  for (const char* message : {"25", "52", "0.5", "5.25", "x5", "5x", "a_5"}) {
    EXPECT_THAT(message, Not(Names("5"))) << message;
  }
  for (const char* message : {"5", "-5", "5.", "= 5,", "a.5", "(5)", "52 and 5"}) {
    EXPECT_THAT(message, Names("5")) << message;
  }
}

TEST(Names, FindsInflectedWords) {
  EXPECT_THAT("scaled by ../scale.txt", Names("scale", "scale.txt"));
  EXPECT_THAT("rescaled, to_scale", Not(Names("scale")));
}

TEST(LineNames, NeedsAllTokensInOneLine) {
  EXPECT_THAT("a 1\nb 2\n", AllOf(LineNames("2", "b"), Not(LineNames("a", "2"))));
  EXPECT_THAT("", Not(LineNames("a")));
}

TEST(LineNaming, FindsTheFirstLine) {
  EXPECT_EQ(LineNaming("b", "a 1\nb 2\nb 3\n"), "b 2");
  EXPECT_EQ(LineNaming("c", "a 1\nabc 2"), "");
}

}  // namespace
}  // namespace msc_vo
