// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_list.h"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::Optional;

// Images of these stamps with different names.
std::vector<ListedImage> Images(const std::vector<double>& stamps) {
  std::vector<ListedImage> images;
  for (size_t i = 0; i < stamps.size(); ++i) {
    images.push_back({stamps[i], std::to_string(i) + ".png", ""});
  }
  return images;
}

// Stamps at 10 Hz.
std::vector<double> StampsFrom(double start, int count) {
  std::vector<double> stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(start + 0.1 * i);
  return stamps;
}

std::vector<double> Joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(ClockStep, IsFoundWherePassagesWouldBeMixed) {
  const std::vector<double> once = Joined(StampsFrom(5.0, 20), StampsFrom(6.03, 20));
  EXPECT_THAT(FindClockStep(Images(once)), Optional(20u));
  EXPECT_THAT(FindClockStep(Images(Joined(StampsFrom(4.0, 5), once))), Optional(25u));
  // The second run begins before the first one and has the same stamps.
  const std::vector<double> same = Joined(StampsFrom(5.0, 20), StampsFrom(4.5, 20));
  EXPECT_THAT(FindClockStep(Images(same)), Optional(20u));
  const std::vector<double> forth = Joined(once, StampsFrom(9.0, 20));
  EXPECT_THAT(FindClockStep(Images(forth)), Optional(20u));
}

TEST(ClockStep, IsNotFoundWhereSortingDoesNoHarm) {
  EXPECT_FALSE(FindClockStep({}));
  EXPECT_FALSE(FindClockStep(Images(StampsFrom(5.0, 40))));
  // Parts in the wrong order.
  EXPECT_FALSE(FindClockStep(Images(Joined(StampsFrom(9.0, 20), StampsFrom(5.0, 20)))));
  std::vector<double> parts;
  for (const double start : {5.0, 9.0, 7.0, 11.0}) parts = Joined(parts, StampsFrom(start, 20));
  EXPECT_FALSE(FindClockStep(Images(parts)));
  // A block that is listed late.
  std::vector<double> late = StampsFrom(5.0, 40);
  std::rotate(late.begin() + 10, late.begin() + 13, late.begin() + 25);
  EXPECT_FALSE(FindClockStep(Images(late)));
  // Neighbours that are exchanged, and an image that is listed late.
  std::vector<double> stamps = StampsFrom(5.0, 40);
  std::swap(stamps[20], stamps[21]);
  EXPECT_FALSE(FindClockStep(Images(stamps)));
  std::rotate(stamps.begin() + 5, stamps.begin() + 6, stamps.begin() + 15);
  EXPECT_FALSE(FindClockStep(Images(stamps)));
  // A list that is not in order anyway, and a short one.
  stamps = StampsFrom(5.0, 40);
  for (int i = 0; i < 40; ++i) std::swap(stamps[i], stamps[(7 * i) % 40]);
  EXPECT_FALSE(FindClockStep(Images(stamps)));
  EXPECT_FALSE(FindClockStep(Images({1.0, 2.0, 3.0, 4.0, 1.5, 2.5, 3.5})));
}

TEST(ClockStep, IgnoresRepeatedRows) {
  std::vector<ListedImage> images = Images(StampsFrom(5.0, 20));
  const std::vector<ListedImage> repeated(images.begin() + 5, images.begin() + 12);
  images.insert(images.end(), repeated.begin(), repeated.end());
  EXPECT_FALSE(FindClockStep(images));
}

}  // namespace
}  // namespace msc_vo
