// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_name.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;

TEST(SortNames, KnowsHexadecimalNumbersFromDecimalOnes) {
  std::vector<std::string> names = {"f00a.png", "f9ff.png", "f010.png"};
  SortNames(&names);
  EXPECT_THAT(names, testing::ElementsAre("f00a.png", "f010.png", "f9ff.png"));
  names = {"10.0166.png", "9.97656.png"};
  SortNames(&names);
  EXPECT_THAT(names, testing::ElementsAre("9.97656.png", "10.0166.png"));
}

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

TEST(SplitName, SeparatesDigitsAndText) {
  const NameParts parts = SplitName("frame-000012.color");
  EXPECT_THAT(parts.digits, ElementsAre("000012"));
  EXPECT_THAT(parts.texts, ElementsAre("frame-", ".color"));
  EXPECT_THAT(SplitName("1.5").texts, ElementsAre("", ".", ""));
  EXPECT_THAT(SplitName("").texts, ElementsAre(""));
}

}  // namespace
}  // namespace msc_vo
