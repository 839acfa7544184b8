// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/named_images.h"

#include <cmath>

#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kNumImages = 40;
constexpr int64_t kStart = 1604645033;  // seconds since 1970: 2020-11-06 06:43:53
constexpr int64_t kNanosecondsPerImage = 33366700;
constexpr int64_t kSecond = 1000000000;

// Nanoseconds of image i.
int64_t Nanoseconds(int i) { return 123456789 + i * kNanosecondsPerImage; }
long long Seconds(int i) { return kStart + Nanoseconds(i) / kSecond; }
long long Fraction(int i, int64_t unit) { return Nanoseconds(i) % kSecond / unit; }

template <typename NameOf>
NamedImages Read(const NameOf& name_of, const std::optional<TimeRange>& reference = std::nullopt) {
  std::vector<std::string> paths;
  for (int i = 0; i < kNumImages; ++i) paths.push_back("rgb/" + name_of(i) + ".png");
  return ReadImageNames(paths, reference);
}

// Expects the times of the images, from the first one on, to within the resolution of the names.
void ExpectTimes(const NamedImages& images, double start, double resolution) {
  ASSERT_EQ(images.certainty, NamedTimes::kCertain);
  ASSERT_EQ(images.times.size(), static_cast<size_t>(kNumImages));
  for (int i = 0; i < kNumImages; ++i) {
    EXPECT_NEAR(images.times[i], start + 1e-9 * static_cast<double>(Nanoseconds(i)), resolution);
  }
}

TEST(NamedImages, ReadsDatesInAnyUnit) {
  const auto start = static_cast<double>(kStart);
  ExpectTimes(Read([](int i) { return FormatText("%lld.%06lld", Seconds(i), Fraction(i, 1000)); }),
              start, 1.5e-6);
  ExpectTimes(Read([](int i) {
                return FormatText("r_Color_%lld%03lld.%03lld", Seconds(i), Fraction(i, 1000000),
                                  Fraction(i, 1000) % 1000);
              }),
              start, 1.5e-6);
  ExpectTimes(Read([](int i) { return FormatText("x2_%lld%09lld", Seconds(i), Fraction(i, 1)); }),
              start, 1e-6);
  ExpectTimes(Read([](int i) {
                return FormatText("%04d-%lld%06lld-left", i, Seconds(i), Fraction(i, 1000));
              }),
              start, 2e-6);
}

TEST(NamedImages, ReadsSecondsAndTheirFractionsInTwoNumbers) {
  const auto start = static_cast<double>(kStart);
  const struct {
    const char* format;
    int64_t unit;
    double resolution;
  } kFormats[] = {{"%lld_%09lld", 1, 1e-6},       {"%lld-%lld", 1, 1e-6},
                  {"%lld.%lld", 1, 1e-6},         {"rgb%lld_%06lld", 1000, 2e-6},
                  {"%lld_%lld", 1000, 2e-6},      {"sec%lld_ms%03lld", 1000000, 2e-3},
                  {"%lld,%lld_color", 1000, 2e-6}};
  for (const auto& f : kFormats) {
    SCOPED_TRACE(f.format);
    ExpectTimes(Read([&](int i) { return FormatText(f.format, Seconds(i), Fraction(i, f.unit)); }),
                start, f.resolution);
  }
}

TEST(NamedImages, ReadsTimesOfDay) {
  const auto start = static_cast<double>(kStart);
  for (const char* format : {"2020-11-06_06-43-%02lld.%03lld", "IMG_20201106_0643%02lld%03lld",
                             "20201106T0643%02lld.%03lldZ", "2020-11-6 6.43.%02lld-%03lld"}) {
    SCOPED_TRACE(format);
    ExpectTimes(Read([&](int i) {
                  return FormatText(format, Seconds(i) - kStart + 53, Fraction(i, 1000000));
                }),
                start, 1.1e-3);
  }
}

TEST(NamedImages, ReadsTimesSinceAnyStart) {
  for (const double start : {0.0, 8123.0, 1234567.0}) {
    SCOPED_TRACE(start);
    const auto time = [&](int i) { return start + 1e-9 * static_cast<double>(Nanoseconds(i)); };
    ExpectTimes(Read([&](int i) { return FormatText("depth_%.0f", 1e3 * time(i)); }), start, 1e-3);
    ExpectTimes(Read([&](int i) { return FormatText("%.0f", 1e6 * time(i)); }), start, 2e-6);
    ExpectTimes(Read([&](int i) { return FormatText("%.0f", 1e9 * time(i)); }), start, 1e-6);
    ExpectTimes(Read([&](int i) { return FormatText("%.4f", time(i)); }), start, 1e-4);
    ExpectTimes(Read([&](int i) { return FormatText("%05d_%.3f", i, 1e3 * time(i)); }), start,
                1e-5);
    ExpectTimes(
        Read([&](int i) { return FormatText("%.0f_%09lld", std::floor(time(i)), Fraction(i, 1)); }),
        start, 1e-6);
  }
}

TEST(NamedImages, SaysInWhichUnitTimesWereRead) {
  const NamedImages images =
      Read([](int i) { return FormatText("%lld%03lld", Seconds(i), Fraction(i, 1000000)); });
  EXPECT_EQ(images.unit, TimeUnit::kMilliseconds);
  EXPECT_THAT(images.warnings, ElementsAre(Names("milliseconds", "1970")));
  EXPECT_THAT(images.description, Names("1604645033.123"));
  EXPECT_THAT(
      Read([](int i) { return FormatText("%lld.%06lld", Seconds(i), Fraction(i, 1000)); }).warnings,
      IsEmpty());
}

TEST(NamedImages, CountersAreFrameNumbers) {
  const auto expect_number = [](const NamedImages& images, int first, int step) {
    EXPECT_NE(images.certainty, NamedTimes::kCertain);
    ASSERT_EQ(images.numbers.size(), static_cast<size_t>(kNumImages));
    EXPECT_EQ(images.numbers.front(), first);
    EXPECT_EQ(images.numbers.back(), first + step * (kNumImages - 1));
    EXPECT_THAT(images.warnings, IsEmpty());
  };
  expect_number(Read([](int i) { return FormatText("frame-%06d.color", i); }), 0, 1);
  expect_number(Read([](int i) { return FormatText("%d", 95 + i); }), 95, 1);
  expect_number(Read([](int i) { return FormatText("cam1.%04d", 7 + 2 * i); }), 7, 2);
  expect_number(Read([](int i) { return FormatText("scene0011_00_%d", 20 * i); }), 0, 20);
  // The date and the time when the recording began, a serial number.
  expect_number(Read([](int i) { return FormatText("20230501_123015_%d", i); }), 0, 1);
  expect_number(Read([](int i) { return FormatText("20230501_123015_%03d", i); }), 0, 1);
  expect_number(Read([](int i) { return FormatText("1305031102_%04d_640x480", i); }), 0, 1);
}

TEST(NamedImages, NumbersWithAConstantStepMayBeTimes) {
  const NamedImages images = Read([](int i) { return std::to_string(33 * i); });
  EXPECT_EQ(images.certainty, NamedTimes::kPossible);
  EXPECT_NEAR(images.times[1], 0.033, 1e-9);
  EXPECT_EQ(images.numbers[1], 33);
  // Every nth frame would be counted from 0 or 1.
  EXPECT_EQ(Read([](int i) { return std::to_string(123456 + 33 * i); }).certainty,
            NamedTimes::kCertain);
}

TEST(NamedImages, DatesWithoutFractionsAreNotUsed) {
  const NamedImages images =
      Read([](int i) { return FormatText("20201106_0643%02d_%03d", 10 + i / 30, i); });
  EXPECT_EQ(images.certainty, NamedTimes::kNone);
  EXPECT_EQ(images.numbers.back(), kNumImages - 1);
  EXPECT_THAT(images.warnings, ElementsAre(Names("dates")));
}

TEST(NamedImages, CountersWithinASecondAreNoFractions) {
  const NamedImages images =
      Read([](int i) { return FormatText("IMG_20230501_1230%02d_%02d", 15 + i / 30, i % 30); });
  EXPECT_NE(images.certainty, NamedTimes::kCertain);
}

TEST(NamedImages, TimesThatGoBackwardsAreNotUsed) {
  const NamedImages images = Read([](int i) {
    return FormatText("%04d_%lld.%06lld", i, Seconds(i) - (i < 20 ? 0 : 7), Fraction(i, 1000));
  });
  EXPECT_EQ(images.certainty, NamedTimes::kNone);
  EXPECT_EQ(images.numbers.size(), static_cast<size_t>(kNumImages));
  EXPECT_THAT(images.warnings, ElementsAre(Names("backwards")));
}

TEST(NamedImages, SecondsOfAMinuteAreNoTimesBeyondIt) {
  const NamedImages images = Read([](int i) {
    const int ms = 33 * i + 59000;
    return FormatText("01-05-2023 12.%02d.%02d.%03d", 30 + ms / 60000, ms / 1000 % 60, ms % 1000);
  });
  EXPECT_EQ(images.certainty, NamedTimes::kNone);
  EXPECT_THAT(images.description, Names("nothing"));
}

TEST(NamedImages, LeavesOutNamesOfAnotherPattern) {
  const NamedImages images = Read([](int i) {
    return i == 3 ? "background_" + std::to_string(i) : FormatText("%.3f", 0.5 * i);
  });
  EXPECT_EQ(images.paths.size(), kNumImages - 1u);
  EXPECT_EQ(images.times.size(), kNumImages - 1u);
  EXPECT_THAT(images.warnings, Contains(Names("1", "40", "background_3.png")));
}

TEST(NamedImages, NumbersMayLackTheirFraction) {
  const NamedImages images = Read([](int i) { return FormatText("%g", 0.25 * i); });
  ASSERT_EQ(images.times.size(), static_cast<size_t>(kNumImages));
  EXPECT_EQ(images.times.back(), 0.25 * (kNumImages - 1));
  EXPECT_THAT(images.warnings, IsEmpty());
}

TEST(NamedImages, SaysThatNamesAreNotUnderstood) {
  for (const auto& name_of : {+[](int i) { return FormatText("%08x", 2654435761u * (i + 1)); },
                              +[](int i) { return FormatText("cam%d_%d", i % 2, i / 2); },
                              +[](int i) { return std::string(i + 1, 'a'); }}) {
    const NamedImages images = Read(name_of);
    EXPECT_EQ(images.certainty, NamedTimes::kNone);
    EXPECT_THAT(images.numbers, IsEmpty());
    EXPECT_THAT(images.description, Names("nothing"));
  }
}

}  // namespace
}  // namespace msc_vo
