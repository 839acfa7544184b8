// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/image_statistics.h"

#include <limits>

#include <gtest/gtest.h>

#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {
namespace {

TEST(MeasureImage, MeasuresGreyLevelsAndDepth) {
  RgbdImage image;
  image.gray = cv::Mat(64, 64, CV_8UC1, cv::Scalar(10));
  image.gray.rowRange(0, 32).setTo(50);
  image.depth = cv::Mat(64, 64, CV_32FC1, cv::Scalar(2.0));
  image.depth.colRange(0, 16).setTo(0.0);
  image.depth.colRange(16, 32).setTo(std::numeric_limits<double>::quiet_NaN());
  const ImageStatistics statistics = MeasureImage(image);
  EXPECT_DOUBLE_EQ(statistics.brightness, 30.0);
  EXPECT_DOUBLE_EQ(statistics.contrast, 20.0);
  EXPECT_DOUBLE_EQ(statistics.measured_depth, 0.5);
}

TEST(MeasureImage, ReturnsZerosForEmptyImage) {
  EXPECT_EQ(MeasureImage(RgbdImage()).contrast, 0.0);
}

}  // namespace
}  // namespace msc_vo
