// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_name.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(NaturalLess, ComparesDigitsAsNumbers) {
  EXPECT_TRUE(NaturalLess("2.png", "10.png"));
  EXPECT_FALSE(NaturalLess("10.png", "2.png"));
  EXPECT_TRUE(NaturalLess("a9b", "a10a"));
  EXPECT_TRUE(NaturalLess("a", "b"));
  EXPECT_TRUE(NaturalLess("a", "aa"));
  EXPECT_TRUE(NaturalLess("99999999999999999999", "100000000000000000000"));
  EXPECT_FALSE(NaturalLess("7", "7"));
  EXPECT_NE(NaturalLess("07", "7"), NaturalLess("7", "07"));  // a fixed order
}

TEST(StampFromName, ParsesTimesDatesAndFrameNumbers) {
  EXPECT_DOUBLE_EQ(*StampFromName("rgb/1305031102.175304.png"), 1305031102.175304);
  EXPECT_DOUBLE_EQ(*StampFromName("rgb/15.png"), 0.5);
  EXPECT_DOUBLE_EQ(*StampFromName("rgb/frame000030.jpg"), 1.0);
  EXPECT_NEAR(*StampFromName("1403636579763555584.png"), 1403636579.763555584, 1e-6);
  EXPECT_NEAR(*StampFromName("1403636579763.png"), 1403636579.763, 1e-6);
  EXPECT_NEAR(*StampFromName("1403636579763555.png"), 1403636579.763555, 1e-6);
  EXPECT_FALSE(StampFromName("rgb/left.png").has_value());
}

TEST(FrameNumber, IsLastNumberOfStem) {
  EXPECT_EQ(FrameNumber("seq-01/frame-000012.color.png"), 12);
  EXPECT_EQ(FrameNumber("a/b7c.png"), 7);
  EXPECT_FALSE(FrameNumber("a7/b.png").has_value());
}

}  // namespace
}  // namespace msc_vo
