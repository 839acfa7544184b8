// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <gtest/gtest.h>

#include "msc_vo/tracking/place_search.h"

namespace msc_vo {
namespace {

constexpr size_t kMany = 1000;

TEST(KeyframesToTry, TriesAsManyPerSecondAtAnyRate) {
  for (const double rate : {5.0, 10.0, 15.0, 30.0, 60.0}) {
    EXPECT_NEAR(KeyframesToTry(3, 1.0 / rate, kMany) * rate, 90.0, 30.0) << rate;
  }
  for (const double rate : {5.0, 10.0, 15.0, 30.0}) {
    EXPECT_EQ(KeyframesToTry(1, 1.0 / rate, kMany) * rate, 30.0) << rate;
  }
  EXPECT_EQ(KeyframesToTry(1, 1.0 / 60.0, kMany), 1);
}

TEST(KeyframesToTry, ToleratesJitterOfTheStamps) {
  for (const double seconds : {0.026, 0.033, 0.04, 0.049}) {
    EXPECT_EQ(KeyframesToTry(3, seconds, kMany), 3);
    EXPECT_EQ(KeyframesToTry(1, seconds, kMany), 1);
  }
}

TEST(KeyframesToTry, IsLimitedAfterAGap) {
  EXPECT_EQ(KeyframesToTry(3, 0.2, kMany), 18);
  EXPECT_EQ(KeyframesToTry(3, 1e9, kMany), 18);
}

TEST(KeyframesToTry, TriesNoKeyframeOfASmallMapTwice) {
  EXPECT_EQ(KeyframesToTry(3, 0.2, 5), 5);
  EXPECT_EQ(KeyframesToTry(3, 0.2, 1), 3);
}

}  // namespace
}  // namespace msc_vo
