// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/time_unit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

// Ten stamps with equal intervals.
std::vector<double> Stamps(double first, double interval) {
  std::vector<double> stamps;
  for (int i = 0; i < 10; ++i) stamps.push_back(first + i * interval);
  return stamps;
}

TEST(GuessTimeUnit, RecognisesDates) {
  EXPECT_EQ(GuessTimeUnit(Stamps(1305031102.1753, 0.033)), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(1305031102175.3, 33)), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(1305031102175304, 33333)), TimeUnit::kMicroseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(1.305031102175304e18, 33333333)), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(1.305031102175304e18, 1000000)), TimeUnit::kNanoseconds);  // 1 kHz
  EXPECT_EQ(GuessTimeUnit({1305031102175304000.0}), TimeUnit::kNanoseconds);
}

// Of Windows since 1601, and of .NET since the year 1.
TEST(GuessTimeUnit, RecognisesDatesInTicks) {
  for (const double start : {132697151032386740.0, 637400000000000000.0}) {
    EXPECT_EQ(GuessTimeUnit(Stamps(start, 333333)), TimeUnit::kHundredNanoseconds);
  }
  EXPECT_EQ(UnitsPerSecond(TimeUnit::kHundredNanoseconds), 1e7);
}

TEST(DescribeSlowRate, DoubtsLongIntervals) {
  EXPECT_NE(DescribeSlowRate(0.333), "");
  EXPECT_EQ(DescribeSlowRate(0.1), "");
}

TEST(GuessTimeUnit, RecognisesIntervalsBetweenImages) {
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 1)), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 33)), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 33333)), TimeUnit::kMicroseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 33333333)), TimeUnit::kNanoseconds);
  // Half an hour after boot: a date in milliseconds with a day between two images.
  EXPECT_EQ(GuessTimeUnit(Stamps(1.8e12, 33333333)), TimeUnit::kNanoseconds);
  EXPECT_EQ(GuessTimeUnit({12.0}), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit({}), TimeUnit::kSeconds);
}

// Two weeks after the start of a machine, its milliseconds are dates in seconds.
TEST(GuessTimeUnit, IntervalsOfImagesDistinguishUptimeFromDates) {
  for (const double start : {1.2e9, 3.6e9}) {
    EXPECT_EQ(GuessTimeUnit(Stamps(start, 33), std::nullopt, kMaxImageInterval),
              TimeUnit::kMilliseconds);
    EXPECT_EQ(GuessTimeUnit(Stamps(start, 2), std::nullopt, kMaxImageInterval), TimeUnit::kSeconds);
    EXPECT_EQ(GuessTimeUnit(Stamps(start, 33)), TimeUnit::kSeconds);  // sparse poses
  }
}

// 4 ms look like 4 s, 4000 us like 4 s in milliseconds, 4e6 ns like 4 s in microseconds.
TEST(GuessTimeUnit, FastStampsHaveTheUnitInWhichTheyCoverTheReference) {
  std::vector<double> seconds;  // at 240 Hz
  for (int i = 0; i < 4800; ++i) seconds.push_back(i / 240.0);
  const TimeRange images{0.0, 20.0, TimeUnit::kSeconds};
  for (const TimeUnit unit : {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                              TimeUnit::kNanoseconds}) {
    std::vector<double> stamps;
    for (const double time : seconds) stamps.push_back(std::round(UnitsPerSecond(unit) * time));
    if (unit == TimeUnit::kSeconds) stamps = seconds;
    EXPECT_EQ(GuessTimeUnit(stamps, images), unit);
  }
}

TEST(GuessTimeUnit, SparsePosesOfOtherTimesAreSeconds) {
  const auto unit_of = [](double first, double interval, int count, double images) {
    std::vector<double> stamps;
    for (int i = 0; i < count; ++i) stamps.push_back(first + i * interval);
    return GuessTimeUnit(stamps, TimeRange{0.0, images, TimeUnit::kSeconds});
  };
  EXPECT_EQ(unit_of(0.0, 0.2, 10000, 30.0), TimeUnit::kSeconds);  // the images are a part
  EXPECT_EQ(unit_of(0.0, 1.0, 3600, 60.0), TimeUnit::kSeconds);
  EXPECT_EQ(unit_of(5000.0, 0.2, 300, 60.0), TimeUnit::kSeconds);  // of another clock
}

TEST(GuessTimeUnit, PrefersUnitOfReference) {
  const TimeRange images = {0.0, 9.0, TimeUnit::kMilliseconds};
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 1)), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 1000), images), TimeUnit::kMilliseconds);
  EXPECT_EQ(GuessTimeUnit(Stamps(0, 1), images), TimeUnit::kSeconds);
  EXPECT_EQ(GuessTimeUnit({0, 1, 2, 9000}, images), TimeUnit::kMilliseconds);  // 1 kHz
}

TEST(CountingStep, IsSmallestStepIfItDividesAll) {
  EXPECT_EQ(CountingStep({30, 0, 10, 10}), 10.0);
  EXPECT_EQ(CountingStep({7, 7}), std::nullopt);
  EXPECT_EQ(CountingStep({0, 33, 67}), std::nullopt);
}

TEST(AreFrameCounts, DistinguishesFramesFromMilliseconds) {
  EXPECT_TRUE(AreFrameCounts({302, 307, 312, 322}));  // a part, every fifth frame
  EXPECT_TRUE(AreFrameCounts({1, 41, 81}));           // every 40th frame
  EXPECT_FALSE(AreFrameCounts({1013, 1053, 1093}));   // 25 Hz
  EXPECT_FALSE(AreFrameCounts({1000, 1033, 1067}));   // 30 Hz
}

}  // namespace
}  // namespace msc_vo
