// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/stamp_precision.h"

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

// Stamps of half a minute at 30 Hz that begin at `start`, in a unit.
std::string Describe(const char* format, double start, double units_per_second = 1.0) {
  std::vector<std::string> stamps;
  for (int i = 0; i < 900; ++i) {
    stamps.push_back(FormatText(format, units_per_second * (start + i / 30.0)));
  }
  return DescribeLostDigits(stamps);
}

TEST(DescribeLostDigits, NamesScientificNotationWithTooFewDigits) {
  EXPECT_THAT(Describe("%.6e", 1604645033.1),
              Names("scientific notation", "1.604645e+09", "1000 s"));
  EXPECT_THAT(Describe("%g", 1604645033.1), Names("scientific notation", "10000 s"));
  EXPECT_THAT(Describe("%.10E", 1604645033.1), Names("scientific notation", "0.1 s"));
  EXPECT_THAT(Describe("%.8e", 1604645033.1, 1e9), Names("scientific notation", "10 s"));
  EXPECT_THAT(Describe("%.2e", 120.0), Names("scientific notation", "1 s"));
}

TEST(DescribeLostDigits, AcceptsAllDigitsInAnyNotation) {
  for (const char* format : {"%.18e", "%.12e", "%.17g", "%f", "%.3f"}) {
    EXPECT_EQ(Describe(format, 1604645033.1), "") << format;
    EXPECT_EQ(Describe(format, 0.0), "") << format;
  }
  EXPECT_EQ(Describe("%.17g", 1604645033.1, 1e9), "");
  EXPECT_EQ(DescribeLostDigits({"1e0"}), "");
  EXPECT_EQ(DescribeLostDigits({"0", "1e-01", "2e-01"}), "");  // not all are scientific
}

TEST(DescribeLostDigits, NamesSinglePrecision) {
  std::vector<std::string> stamps;
  for (int i = 0; i < 900; ++i) {
    stamps.push_back(FormatText("%.6f", static_cast<float>(1604645033.1 + i / 30.0)));
  }
  EXPECT_THAT(DescribeLostDigits(stamps), Names("single precision", "128 s"));
}

std::vector<std::string> Restored(const std::vector<std::string>& stamps) {
  std::vector<TextLine> lines;
  for (const std::string& stamp : stamps) lines.push_back({"file", 1, {"a", stamp}, ""});
  const bool changed = RestoreFractions(1, &lines);
  std::vector<std::string> restored;
  for (const TextLine& line : lines) restored.push_back(line.fields[1]);
  EXPECT_EQ(changed, restored != stamps);
  return restored;
}

TEST(RestoreFractions, AddsZerosIfTheStampsAscendOnlyWithThem) {
  using Stamps = std::vector<std::string>;
  EXPECT_EQ(Restored({"7.966666667", "8.0", "8.33333333", "8.100000000"}),
            (Stamps{"7.966666667", "8.000000000", "8.033333333", "8.100000000"}));
  EXPECT_EQ(Restored({"1.900", "2.5", "2.40", "2.75"}),
            (Stamps{"1.900", "2.005", "2.040", "2.075"}));
  const Stamps others[] = {{"7.9", "8.0", "8.05", "8.1"},          // zeros at the end are missing
                           {"7.9", "8.5", "8.25", "9.0", "8.75"},  // in no order
                           {"7.9", "8", "8.33", "8.1"},
                           {"7.9", "8.5e0", "8.33"},
                           {"7.9", "8.1234567890", "8.05"}};
  for (const Stamps& stamps : others) EXPECT_EQ(Restored(stamps), stamps) << stamps[1];
}

}  // namespace
}  // namespace msc_vo
