// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/image_parts.h"

#include <limits>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::ElementsAre;

// Four columns and two rows of 25 x 50 pixels.
ImageParts FourByTwo() {
  PinholeCamera camera;
  camera.width = 100;
  camera.height = 100;
  return {4, 2, camera};
}

TEST(ImageParts, AreNumberedRowByRow) {
  const ImageParts parts = FourByTwo();
  EXPECT_EQ(parts.size(), 8);
  EXPECT_EQ(parts.PartOf({10.0, 10.0}), 0);
  EXPECT_EQ(parts.PartOf({60.0, 10.0}), 2);
  EXPECT_EQ(parts.PartOf({60.0, 70.0}), 6);
  for (int part = 0; part < parts.size(); ++part) {
    EXPECT_EQ(parts.PartOf(100.0 * parts.CenterOf(part)), part);
  }
}

TEST(ImageParts, PixelsOutsideBelongToTheNearest) {
  const ImageParts parts = FourByTwo();
  EXPECT_EQ(parts.PartOf({-3.0, 20.0}), 0);
  EXPECT_EQ(parts.PartOf({102.0, 20.0}), 3);
  EXPECT_EQ(parts.PartOf({60.0, 104.0}), 6);
}

TEST(ImageParts, PixelsThatAreNoNumbersBelongToSomePart) {
  const ImageParts parts = FourByTwo();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(parts.PartOf({nan, nan}), 0);
  EXPECT_EQ(parts.PartOf({1e300, -1e300}), 3);
  for (const int part : parts.PartsOf({{nan, 0.0}, {1e300, 1e300}})) {
    EXPECT_GE(part, 0);
    EXPECT_LT(part, parts.size());
  }
}

TEST(ImageParts, SegmentsRunThroughSeveral) {
  const ImageParts parts = FourByTwo();
  EXPECT_THAT(parts.PartsOf({{90.0, 20.0}, {10.0, 20.0}}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(parts.PartsOf({{10.0, 20.0}, {10.0, 90.0}}), ElementsAre(0, 4));
  EXPECT_THAT(parts.PartsOf({{10.0, 20.0}, {12.0, 22.0}}), ElementsAre(0));
  EXPECT_EQ(parts.PartOf(LineSegment2{{90.0, 20.0}, {14.0, 20.0}}), 2);
}

}  // namespace
}  // namespace msc_vo
