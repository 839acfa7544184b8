// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/descriptor.h"

#include <random>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(HammingDistance, CountsDifferingBits) {
  Descriptor a{};
  Descriptor b{};
  EXPECT_EQ(HammingDistance(a, b), 0);
  b[0] = 0x01;
  b[31] = 0x80;
  EXPECT_EQ(HammingDistance(a, b), 2);
  a.fill(0xff);
  b.fill(0x00);
  EXPECT_EQ(HammingDistance(a, b), 256);
}

TEST(HammingDistance, MatchesBitwiseCount) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    Descriptor a;
    Descriptor b;
    int expected = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      a[k] = static_cast<uint8_t>(random());
      b[k] = static_cast<uint8_t>(random());
      for (int bit = 0; bit < 8; ++bit) expected += ((a[k] ^ b[k]) >> bit) & 1;
    }
    EXPECT_EQ(HammingDistance(a, b), expected);
  }
}

}  // namespace
}  // namespace msc_vo
