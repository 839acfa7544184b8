// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_source.h"

#include <cmath>
#include <limits>

#include "tests/features/depth_images.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/features/line_backprojection.h"

namespace msc_vo {
namespace {

using testing::kVgaCamera;

PointFeature PointAt(double x, double y, bool has_depth = true) {
  PointFeature point;
  point.pixel = {x, y};
  point.inverse_depth = has_depth ? 0.5 : 0.0;
  point.inverse_depth_sigma = has_depth ? 0.01 : 0.0;
  return point;
}

TEST(ShareDepthErrors, CountsTheErrorOfCloseFeaturesOnce) {
  Frame frame;
  frame.camera = kVgaCamera;
  frame.points = {PointAt(100, 100), PointAt(103, 100), PointAt(100, 104), PointAt(300, 200),
                  PointAt(304, 200, false)};
  frame.grid = FeatureGrid(frame.camera, frame.points);
  Frame unchanged = frame;
  ShareDepthErrors(0.0, &unchanged);
  EXPECT_EQ(unchanged.points[0].inverse_depth_sigma, 0.01);
  ShareDepthErrors(8.0, &frame);
  // Three observations with three times the variance have the information of one.
  for (const int i : {0, 1, 2}) {
    EXPECT_NEAR(frame.points[i].inverse_depth_sigma, 0.01 * std::sqrt(3.0), 1e-12);
  }
  EXPECT_EQ(frame.points[3].inverse_depth_sigma, 0.01);
  EXPECT_EQ(frame.points[4].inverse_depth_sigma, 0.0);
}

// A wall at 2 m with the noise of the sensor along a line of 300 px.
TEST(DepthSource, LinesCountCorrelatedNoiseOnce) {
  const cv::Mat depth = testing::DrawDepth(kVgaCamera, [](const Eigen::Vector2d&) { return 0.5; });
  const InverseDepthImage image(depth, 0.2, 10.0);
  const LensRemap lens(kVgaCamera, LensDistortion());
  const LineSegment2 segment{{100.0, 200.0}, {400.0, 200.0}};
  DepthNoise noise = 0.003;
  const auto independent = [&](double length) {
    noise.correlation_length = length;
    Eigen::Matrix2d covariance = FitDepthAlongLine(image, lens, segment, noise, 1)->covariance;
    covariance.array() -= std::pow(0.5 * 0.003, 2);  // the error that all samples have in common
    return covariance;
  };
  // Samples are 3 px apart: with a correlation over 9 px, three of them are one.
  EXPECT_TRUE(independent(9.0).isApprox(3.0 * independent(3.0), 1e-9));
  EXPECT_TRUE(independent(1.0).isApprox(independent(3.0), 1e-9));
}

TEST(DepthSource, RemovesTheBleedingOfStereo) {
  // A post 1 m away in front of a wall at 2 m, dark on bright. It extends by 4 px in the depth.
  cv::Mat gray(kVgaCamera.height, kVgaCamera.width, CV_8UC1, cv::Scalar(200));
  gray.colRange(300, 340).setTo(50);
  const auto post = [](const Eigen::Vector2d& pixel) {
    return pixel.x() > 295.5 && pixel.x() < 343.5 ? 1.0 : 0.5;
  };
  DepthSource source(DepthSensor::kStereo, SensorNoiseOptions(), 0.2, 10.0, kVgaCamera.width);
  cv::Mat depth = testing::DrawDepth(kVgaCamera, post);
  depth.at<float>(204, 320) = std::numeric_limits<float>::quiet_NaN();
  depth.at<float>(204, 352) = 50.0f;  // out of range
  RgbdImage image;
  image.gray = gray;
  image.depth = depth;
  source.Assign(image);
  for (const int x : {290, 299, 340, 350}) EXPECT_NEAR(source.image().At(x, 200), 0.5, 0.002) << x;
  for (const int x : {300, 320, 339}) EXPECT_NEAR(source.image().At(x, 200), 1.0, 0.002) << x;
}

TEST(DepthSource, TheImageAsRecordedTellsTheSensor) {
  // Noise of time of flight, which registration has smoothed.
  RgbdImage image;
  image.recorded_depth = testing::DrawDepth(
      kVgaCamera, [](const Eigen::Vector2d& pixel) { return 0.25 + 0.0008 * pixel.x(); });
  cv::Mat noise(image.recorded_depth.size(), CV_32FC1);
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 0.0, 0.006);
  image.recorded_depth += noise;
  cv::GaussianBlur(image.recorded_depth, image.depth, cv::Size(), 3.0);
  image.gray = cv::Mat(image.depth.size(), CV_8UC1, cv::Scalar(100));
  const auto sensor = [&] {
    DepthSource source(DepthSensor::kAuto, SensorNoiseOptions(), 0.2, 10.0, kVgaCamera.width);
    source.Assign(image);
    return source.sensor();
  };
  EXPECT_EQ(sensor(), DepthSensor::kTimeOfFlight);
  image.recorded_depth.release();
  EXPECT_NE(sensor(), DepthSensor::kTimeOfFlight);
}

}  // namespace
}  // namespace msc_vo
