// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/association.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

std::vector<std::pair<int, int>> Match(const std::vector<double>& reference,
                                       const std::vector<double>& query, double max_difference) {
  std::vector<std::pair<int, int>> pairs;
  for (const StampMatch& match : MatchNearest(reference, query, max_difference)) {
    pairs.emplace_back(match.reference, match.query);
  }
  return pairs;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(MatchNearest, TakesTheNearestStamp) {
  EXPECT_EQ(Match({0.0, 0.1, 0.2}, {0.01, 0.19}, 0.02), (Pairs{{0, 0}, {2, 1}}));
}

TEST(MatchNearest, DropsWhatIsTooFar) {
  EXPECT_EQ(Match({0.0, 0.1, 0.2}, {0.03, 0.1}, 0.02), (Pairs{{1, 1}}));
}

TEST(MatchNearest, IsOneToOneAndTheClosestWins) {
  EXPECT_EQ(Match({0.0, 1.0}, {0.99, 1.005, 1.01}, 0.02), (Pairs{{1, 1}}));
}

TEST(MatchNearest, PrefersTheEarlierOfTwoAtTheSameDistance) {
  EXPECT_EQ(Match({0.0, 1.0}, {0.5}, 0.5), (Pairs{{0, 0}}));
  EXPECT_EQ(Match({0.5}, {0.0, 1.0}, 0.5), (Pairs{{0, 0}}));
}

TEST(MatchNearest, HandlesEmptyInputAndStampsOutsideTheRange) {
  EXPECT_TRUE(Match({}, {1.0}, 1.0).empty());
  EXPECT_TRUE(Match({1.0}, {}, 1.0).empty());
  EXPECT_EQ(Match({1.0, 2.0}, {0.9, 2.1}, 0.2), (Pairs{{0, 0}, {1, 1}}));
}

}  // namespace
}  // namespace msc_vo
