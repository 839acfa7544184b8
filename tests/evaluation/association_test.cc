// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/association.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs Associate(const std::vector<double>& reference, const std::vector<double>& query,
                double max_difference) {
  Pairs pairs;
  for (const StampMatch& match : AssociateStamps(reference, query, max_difference)) {
    pairs.emplace_back(match.reference, match.query);
  }
  return pairs;
}

// The definition: sorts all pairs by difference and takes each whose stamps are both unmatched.
Pairs AssociateExhaustively(const std::vector<double>& reference, const std::vector<double>& query,
                            double max_difference) {
  std::vector<std::tuple<double, int, int>> candidates;
  for (size_t i = 0; i < reference.size(); ++i) {
    for (size_t j = 0; j < query.size(); ++j) {
      const double difference = std::abs(reference[i] - query[j]);
      if (difference <= max_difference) candidates.emplace_back(difference, i, j);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> reference_matched(reference.size()), query_matched(query.size());
  Pairs pairs;
  for (const auto& [difference, i, j] : candidates) {
    if (reference_matched[i] || query_matched[j]) continue;
    reference_matched[i] = query_matched[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(AssociateStamps, MatchesNearestStamp) {
  EXPECT_EQ(Associate({0.0, 0.1, 0.2}, {0.01, 0.19}, 0.02), (Pairs{{0, 0}, {2, 1}}));
}

TEST(AssociateStamps, DropsStampsBeyondMaxDifference) {
  EXPECT_EQ(Associate({0.0, 0.1, 0.2}, {0.03, 0.1}, 0.02), (Pairs{{1, 1}}));
}

TEST(AssociateStamps, MatchesOneToOneClosestFirst) {
  EXPECT_EQ(Associate({0.0, 1.0}, {0.99, 1.005, 1.01}, 0.02), (Pairs{{1, 1}}));
}

TEST(AssociateStamps, MatchesNextNearestIfNearestIsTaken) {
  EXPECT_EQ(Associate({1.00, 1.01}, {0.99, 1.009}, 0.02), (Pairs{{0, 0}, {1, 1}}));
}

TEST(AssociateStamps, PrefersEarlierStampOnTies) {
  EXPECT_EQ(Associate({0.0, 1.0}, {0.5}, 0.5), (Pairs{{0, 0}}));
  EXPECT_EQ(Associate({0.5}, {0.0, 1.0}, 0.5), (Pairs{{0, 0}}));
}

TEST(AssociateStamps, HandlesEmptyListsAndStampsOutsideRange) {
  EXPECT_TRUE(Associate({}, {1.0}, 1.0).empty());
  EXPECT_TRUE(Associate({1.0}, {}, 1.0).empty());
  EXPECT_EQ(Associate({1.0, 2.0}, {0.9, 2.1}, 0.2), (Pairs{{0, 0}, {1, 1}}));
}

// Stamps in seconds that are rounded to a resolution.
std::vector<double> Rounded(std::vector<double> stamps, double resolution) {
  for (double& stamp : stamps) stamp = std::round(stamp / resolution) * resolution;
  return stamps;
}

TEST(AssociateStamps, MatchesEqualStampsInTheirOrder) {
  EXPECT_EQ(Associate({1, 1, 1, 2}, {1, 1, 1, 2}, 0.0), (Pairs{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(Associate({1, 1, 1, 2}, {1, 1, 2}, 0.02), (Pairs{{0, 0}, {1, 1}, {3, 2}}));
  EXPECT_EQ(Associate({1, 2, 2}, {1, 1, 1, 2}, 0.02), (Pairs{{0, 0}, {1, 3}}));
  // Equal only up to the rounding of a conversion.
  EXPECT_EQ(Associate({1, 1, 1}, {1 + 1e-15, 1 + 1e-15, 1 + 1e-15}, 0.02),
            (Pairs{{0, 0}, {1, 1}, {2, 2}}));
  // Only one list is rounded.
  EXPECT_EQ(Associate({1, 1, 1}, {0.97, 1.0, 1.03}, 0.05), (Pairs{{0, 0}, {1, 1}, {2, 2}}));
  EXPECT_EQ(Associate({0.97, 1.0, 1.03}, {1, 1, 1}, 0.05), (Pairs{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(AssociateStamps, KeepsOrderAtAnyResolution) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> times(40);
    for (double& time : times) time = random() / 4294967296.0;
    std::sort(times.begin(), times.end());
    for (const double resolution : {0.02, 0.1, 0.3}) {
      const std::vector<double> coarse = Rounded(times, resolution);
      Pairs expected;
      for (int i = 0; i < static_cast<int>(times.size()); ++i) expected.emplace_back(i, i);
      EXPECT_EQ(Associate(coarse, coarse, 0.5 * resolution), expected);
      // Whatever is matched does not cross.
      const Pairs pairs = Associate(coarse, times, 0.5 * resolution);
      for (size_t i = 1; i < pairs.size(); ++i) EXPECT_LT(pairs[i - 1].second, pairs[i].second);
    }
  }
}

TEST(AssociateStamps, AgreesWithExhaustiveSearch) {
  std::mt19937 random(1);
  const auto make_stamps = [&] {
    std::vector<double> stamps(random() % 60);
    for (double& stamp : stamps) stamp = random() / 4294967296.0;
    std::sort(stamps.begin(), stamps.end());
    return stamps;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<double> reference = make_stamps(), query = make_stamps();
    for (const double max_difference : {0.005, 0.05, 2.0}) {
      EXPECT_EQ(Associate(reference, query, max_difference),
                AssociateExhaustively(reference, query, max_difference));
    }
  }
}

}  // namespace
}  // namespace msc_vo
