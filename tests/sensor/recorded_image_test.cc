// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/recorded_image.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(RecordedImage, KeepsDepthToAnEighthOfAMillimetre) {
  cv::Mat depth(2, 3, CV_32FC1, cv::Scalar(0.0));
  depth.at<float>(0, 1) = 1.23456f;
  depth.at<float>(1, 2) = 15.9f;
  const cv::Mat gray(2, 3, CV_8UC1, cv::Scalar(77));
  const RecordedImage image(gray, depth, DepthSensor::kStructuredLight);
  EXPECT_LE(cv::norm(image.Depth(), depth, cv::NORM_INF), 0.000126);
  EXPECT_EQ(cv::norm(image.Gray(), gray, cv::NORM_INF), 0.0);
  EXPECT_NEAR(image.At(1, 0), 1.0 / 1.23456, 1e-4);
  EXPECT_EQ(image.At(0, 0), 0.0);
  EXPECT_EQ(image.At(3, 0), 0.0);
  EXPECT_EQ(image.At(0, -1), 0.0);
}

TEST(RecordedImage, WhatIsNoDepthOrTooFarIsNoMeasurement) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const cv::Mat depth = (cv::Mat_<float>(1, 4) << nan, infinity, -1.0f, 17.0f);
  const RecordedImage image(cv::Mat(1, 4, CV_8UC1, cv::Scalar(0)), depth,
                            DepthSensor::kStructuredLight);
  EXPECT_EQ(cv::countNonZero(image.Depth()), 0);
}

// A plane that is inclined in both directions, in inverse depth, with grey values like it.
TEST(RecordedImage, ReducesWideImages) {
  for (const cv::Size size : {cv::Size(320, 240), cv::Size(641, 479), cv::Size(1280, 720)}) {
    cv::Mat depth(size, CV_32FC1), gray(size, CV_8UC1);
    const double scale = 1.0 / size.width;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        depth.at<float>(y, x) = static_cast<float>(1.0 / (0.3 + 0.2 * scale * (x + y)));
        gray.at<uint8_t>(y, x) = static_cast<uint8_t>(200.0 * scale * x);
      }
    }
    const RecordedImage image(gray, depth, DepthSensor::kStructuredLight);
    const int step = image.step();
    EXPECT_NEAR(size.width / step, 320, 1);
    for (const cv::Point kept : {cv::Point(0, 0), cv::Point(17, 90), cv::Point(319, 119)}) {
      EXPECT_NEAR(image.At(kept.x, kept.y), 0.3 + 0.2 * scale * step * (kept.x + kept.y), 1e-4);
    }
    EXPECT_EQ(image.At((size.width + step - 1) / step, 0), 0.0);
    ASSERT_EQ(image.Depth().size(), size);
    ASSERT_EQ(image.Gray().size(), size);
    const double max_slope = 0.2 * scale * 2 / (0.3 * 0.3);  // metres per pixel
    EXPECT_LE(cv::norm(image.Depth(), depth, cv::NORM_INF), max_slope * step);
    EXPECT_LE(cv::norm(image.Gray(), gray, cv::NORM_INF), 200.0 * scale * step + 1.0);
    // Apart from the pixels beyond the last kept ones, depth is not displaced.
    const cv::Rect inside(step, step, size.width - 2 * step, size.height - 2 * step);
    EXPECT_LE(cv::norm(image.Depth()(inside), depth(inside), cv::NORM_INF), 0.1 * max_slope + 3e-4);
  }
}

// An edge and a hole, which must not spread.
TEST(RecordedImage, InterpolatesOnOneSurfaceOnly) {
  cv::Mat depth(480, 640, CV_32FC1, cv::Scalar(2.0)), gray(480, 640, CV_8UC1, cv::Scalar(20));
  depth.colRange(301, 640).setTo(1.0);
  gray.colRange(301, 640).setTo(200);
  depth.rowRange(0, 100).setTo(0.0);
  const RecordedImage image(gray, depth, DepthSensor::kStructuredLight);
  const cv::Mat found = image.Depth(), found_gray = image.Gray();
  int edge = 0, gray_edge = 0;
  for (int x = 0; x < 640; ++x) {
    const auto z = found.at<float>(300, x);
    EXPECT_TRUE(z == 1.0f || z == 2.0f || z == 0.0f) << x;
    edge += z == 2.0f;
    gray_edge += found_gray.at<uint8_t>(300, x) < 110;
  }
  EXPECT_NEAR(edge, 301, 1);
  EXPECT_NEAR(gray_edge, edge, 1);
  EXPECT_EQ(cv::countNonZero(found.rowRange(0, 98)), 0);
  EXPECT_EQ(cv::countNonZero(found.rowRange(102, 480)), 378 * 640);
}

TEST(RecordedImage, KeepsTheSensor) {
  const cv::Mat depth(2, 3, CV_32FC1, cv::Scalar(1.0));
  EXPECT_EQ(RecordedImage({}, depth, DepthSensor::kStereo).sensor(), DepthSensor::kStereo);
}

TEST(RecordedImage, MayBeEmpty) {
  const RecordedImage image;
  EXPECT_TRUE(image.Depth().empty());
  EXPECT_TRUE(image.Gray().empty());
  EXPECT_EQ(image.At(0, 0), 0.0);
}

}  // namespace
}  // namespace msc_vo
