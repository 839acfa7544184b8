// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Images that are views of larger matrices give the features of their copies, to the last bit.

#include "tests/support/image_views.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/image_statistics.h"
#include "msc_vo/features/surface_normals.h"

namespace msc_vo {
namespace {

const PinholeCamera kCamera = {240.0, 240.0, 159.5, 119.5, 320, 240};

// Bright and dark boxes of several sizes, many of which the border cuts, in front of a wall.
RgbdImage Boxes() {
  RgbdImage image;
  image.gray = cv::Mat(kCamera.height, kCamera.width, CV_8UC1, cv::Scalar(90));
  image.depth = cv::Mat(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(3.3));
  cv::RNG random(7);
  for (int i = 0; i < 60; ++i) {
    const cv::Point center(random.uniform(0, kCamera.width), random.uniform(0, kCamera.height));
    const cv::Point side(random.uniform(6, 40), random.uniform(6, 40));
    cv::rectangle(image.gray, center - side, center + side, cv::Scalar(random.uniform(0, 255)),
                  cv::FILLED);
    cv::rectangle(image.depth, center - side, center + side, cv::Scalar(random.uniform(1.0, 3.0)),
                  cv::FILLED);
  }
  cv::Mat noise(image.gray.size(), CV_8UC1);
  random.fill(noise, cv::RNG::UNIFORM, 0, 8);
  image.gray += noise;
  return image;
}

std::vector<RgbdImage> Views(const RgbdImage& image) {
  const std::vector<cv::Mat> grays = ViewsOf(image.gray), depths = ViewsOf(image.depth);
  std::vector<RgbdImage> views;
  for (size_t i = 0; i < grays.size(); ++i) {
    views.push_back(image);
    views.back().gray = grays[i];
    views.back().depth = depths[i];
  }
  return views;
}

template <typename T>
std::string BytesOf(T value) {
  ObjectJournal journal;
  BinaryWriter writer(&journal);
  writer(value);
  return writer.bytes();
}

// The frame of a builder that has seen no other image.
std::string FrameBytes(const FrameBuilderOptions& options, const LensDistortion& lens,
                       const RgbdImage& image) {
  FrameBuilder builder(options, kCamera, lens);
  const Frame frame = builder.Build(image);
  EXPECT_GT(frame.points.size(), 100u);
  EXPECT_GT(frame.lines.size(), 20u);
  return BytesOf(frame.points) + BytesOf(frame.lines) + BytesOf(frame.depth_ranges);
}

TEST(ImageViews, GiveTheFrameOfACopy) {
  const RgbdImage image = Boxes();
  for (const LineDetector detector : {LineDetector::kEdgeDrawing, LineDetector::kLsd}) {
    for (const DepthSensor sensor :
         {DepthSensor::kAuto, DepthSensor::kStructuredLight, DepthSensor::kTimeOfFlight,
          DepthSensor::kStereo, DepthSensor::kLidar}) {
      for (const double k1 : {0.0, 0.1}) {
        FrameBuilderOptions options;
        options.lines.detector = detector;
        options.depth_sensor = sensor;
        const LensDistortion lens{{k1, 0.0, 0.0, 0.0, 0.0}};
        const std::string expected = FrameBytes(options, lens, image);
        for (const RgbdImage& view : Views(image)) {
          EXPECT_TRUE(FrameBytes(options, lens, view) == expected)
              << ToString(sensor) << ", detector " << static_cast<int>(detector) << ", k1 " << k1;
        }
      }
    }
  }
}

TEST(ImageViews, GiveTheNormalsAndTheStatisticsOfACopy) {
  const RgbdImage image = Boxes();
  SurfaceNormalEstimator estimator(SurfaceNormalOptions(), kCamera, {});
  const std::vector<SurfaceNormal> expected = estimator.Estimate(image.depth);
  ASSERT_GT(expected.size(), 10u);
  for (const RgbdImage& view : Views(image)) {
    EXPECT_EQ(MeasureImage(view).brightness, MeasureImage(image).brightness);
    const std::vector<SurfaceNormal> normals = estimator.Estimate(view.depth);
    ASSERT_EQ(normals.size(), expected.size());
    for (size_t i = 0; i < normals.size(); ++i) {
      EXPECT_EQ(normals[i].direction, expected[i].direction) << i;
    }
  }
}

}  // namespace
}  // namespace msc_vo
