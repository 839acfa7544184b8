// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

using Pairs = std::vector<WindowIndex::Pair>;

// The lines that stay in the reduced system.
std::vector<int> ReducedLines(int num_lines, const Pairs& pairs) {
  const std::vector<bool> flags = LinesInReducedSystem(num_lines, pairs);
  EXPECT_EQ(flags.size(), static_cast<size_t>(num_lines));
  std::vector<int> lines;
  for (int i = 0; i < num_lines; ++i) {
    if (flags[i]) lines.push_back(i);
  }
  return lines;
}

TEST(LinesInReducedSystem, EliminatesAllLinesWithoutPairs) {
  EXPECT_THAT(ReducedLines(0, {}), ElementsAre());
  EXPECT_THAT(ReducedLines(4, {}), ElementsAre());
}

TEST(LinesInReducedSystem, EliminatesTheFirstLineOfASinglePair) {
  EXPECT_THAT(ReducedLines(3, {{0, 2}}), ElementsAre(2));
  EXPECT_THAT(ReducedLines(3, {{2, 0}}), ElementsAre(2));
}

TEST(LinesInReducedSystem, KeepsTheCentreOfAStar) {
  EXPECT_THAT(ReducedLines(6, {{0, 3}, {3, 1}, {2, 3}, {3, 4}}), ElementsAre(3));
}

TEST(LinesInReducedSystem, KeepsAllButOneLineOfAClique) {
  Pairs pairs;
  for (int a = 0; a < 5; ++a) {
    for (int b = a + 1; b < 5; ++b) pairs.push_back({a, b});
  }
  EXPECT_THAT(ReducedLines(5, pairs), ElementsAre(1, 2, 3, 4));
}

TEST(LinesInReducedSystem, KeepsEverySecondLineOfAChain) {
  // The ends have one partner and are eliminated first, then line 2.
  EXPECT_THAT(ReducedLines(5, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}), ElementsAre(1, 3));
}

TEST(LinesInReducedSystem, KeepsTheWellConnectedLinesOfTwoFamilies) {
  // Lines 6 and 7 are paired with each other and with three lines each.
  EXPECT_THAT(ReducedLines(8, {{0, 6}, {1, 6}, {2, 6}, {3, 7}, {4, 7}, {5, 7}, {6, 7}}),
              ElementsAre(6, 7));
}

TEST(LinesInReducedSystem, CountsRepeatedPairs) {
  // A cycle: with the repeated pair, line 1 and not line 0 is the first with the fewest pairs.
  EXPECT_THAT(ReducedLines(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}), ElementsAre(1, 3));
  EXPECT_THAT(ReducedLines(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {3, 0}}), ElementsAre(0, 2));
}

TEST(LinesInReducedSystem, IsAMinimalCoverOfThePairs) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const int num_lines = 2 + trial;
    std::uniform_int_distribution<int> line(0, num_lines - 1);
    Pairs pairs;
    for (int i = 0; i < 2 * num_lines; ++i) {
      const int a = line(random), b = line(random);
      if (a != b) pairs.push_back({a, b});
    }
    const std::vector<bool> reduced = LinesInReducedSystem(num_lines, pairs);
    std::vector<bool> has_eliminated_partner(num_lines, false);
    for (const auto& [a, b] : pairs) {
      EXPECT_TRUE(reduced[a] || reduced[b]) << "lines " << a << " and " << b;
      if (!reduced[a]) has_eliminated_partner[b] = true;
      if (!reduced[b]) has_eliminated_partner[a] = true;
    }
    // No line stays that could be eliminated.
    EXPECT_EQ(reduced, has_eliminated_partner) << "trial " << trial;
  }
}

TEST(LinesInReducedSystem, DoesNotDependOnTheOrderOfPairs) {
  Pairs pairs{{0, 4}, {1, 4}, {2, 5}, {3, 5}, {4, 5}, {0, 1}, {2, 3}};
  const std::vector<bool> expected = LinesInReducedSystem(6, pairs);
  std::reverse(pairs.begin(), pairs.end());
  for (auto& [a, b] : pairs) std::swap(a, b);
  EXPECT_EQ(LinesInReducedSystem(6, pairs), expected);
}

}  // namespace
}  // namespace msc_vo
