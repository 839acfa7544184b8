// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/html_text.h"

#include <limits>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(EscapeHtml, EscapesSpecialCharacters) {
  EXPECT_EQ(EscapeHtml("<a href=\"x\">R&D's</a>"),
            "&lt;a href=&quot;x&quot;&gt;R&amp;D&#39;s&lt;/a&gt;");
}

TEST(EscapeHtml, KeepsOtherCharacters) {
  EXPECT_EQ(EscapeHtml("Stra\xc3\x9f"
                       "e 1"),
            "Stra\xc3\x9f"
            "e 1");
}

TEST(FormatFixed, RoundsToTheGivenDecimals) {
  EXPECT_EQ(FormatFixed(1234.5678, 2), "1234.57");
  EXPECT_EQ(FormatFixed(-0.5, 1), "-0.5");
  EXPECT_EQ(FormatFixed(3.0, 0), "3");
}

TEST(FormatFixed, HasNoNegativeZero) { EXPECT_EQ(FormatFixed(-0.001, 1), "0.0"); }

TEST(FormatFixed, ShowsADashForNonFiniteValues) {
  EXPECT_EQ(FormatFixed(std::numeric_limits<double>::quiet_NaN(), 2), "-");
  EXPECT_EQ(FormatFixed(std::numeric_limits<double>::infinity(), 2), "-");
}

TEST(FormatFixed, FormatsTheLongestDouble) {
  EXPECT_EQ(FormatFixed(-std::numeric_limits<double>::max(), 0).size(), 310u);
}

}  // namespace
}  // namespace msc_vo
