// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_statistics.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace msc_vo {
namespace {

constexpr int kWallWidth = 640, kWallHeight = 240;

// A wall 1.3 to 4 m away.
cv::Mat Wall() {
  cv::Mat depth(kWallHeight, kWallWidth, CV_32FC1);
  for (int y = 0; y < kWallHeight; ++y) {
    for (int x = 0; x < kWallWidth; ++x) {
      depth.at<float>(y, x) = static_cast<float>(1.0 / (0.25 + 0.0008 * x));
    }
  }
  return depth;
}

// Applies `disturb`, which is given a depth and a normal deviate of unit variance. The deviates are
// smoothed by a Gaussian of `blur` pixels.
cv::Mat Disturbed(cv::Mat depth, double blur,
                  const std::function<double(double, double)>& disturb) {
  cv::Mat noise(depth.size(), CV_32FC1);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
  if (blur > 0.0) {
    cv::GaussianBlur(noise, noise, cv::Size(), blur);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    noise /= deviation[0];
  }
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      float& z = depth.at<float>(y, x);
      z = static_cast<float>(disturb(z, noise.at<float>(y, x)));
    }
  }
  return depth;
}

double TimeOfFlight(double z, double noise) { return z + noise * (0.002 + 0.002 * z); }
double Disparity(double z, double noise) { return 1.0 / (1.0 / z + 0.002 * noise); }

TEST(DepthStatistics, MeasuresTheNoise) {
  const DepthStatistics white = MeasureDepthStatistics(Disturbed(Wall(), 0.0, Disparity));
  EXPECT_NEAR(white.near_noise, 0.002, 0.0001);
  EXPECT_NEAR(white.far_noise, 0.002, 0.0001);
  EXPECT_NEAR(white.exponent.value(), 2.0, 0.2);
  const DepthStatistics smooth = MeasureDepthStatistics(Disturbed(Wall(), 4.0, Disparity));
  EXPECT_LT(smooth.near_noise, 0.0002);
  // Smoothing by 4 px leaves correlations of exp(-1) and exp(-4) over 8 and 16 px.
  const double correlated = (6.0 - 8.0 * std::exp(-1.0) + 2.0 * std::exp(-4.0)) / 6.0;
  EXPECT_NEAR(smooth.far_noise, 0.002 * std::sqrt(correlated), 0.0002);
  const DepthStatistics phase = MeasureDepthStatistics(Disturbed(Wall(), 0.0, TimeOfFlight));
  EXPECT_NEAR(phase.exponent.value(), 0.65, 0.25);
}

TEST(DepthStatistics, MeasuresTheResolutionOfDisparity) {
  const cv::Mat depth = Disturbed(Wall(), 1.5, [](double z, double noise) {
    return 1.0 / (0.003 * std::round((1.0 / z + 0.001 * noise) / 0.003));
  });
  EXPECT_NEAR(MeasureDepthStatistics(depth).step, 0.003, 1e-5);
}

TEST(ClassifyDepthSensor, TellsTheSensorsApart) {
  const auto classify = [](const cv::Mat& depth) {
    return ClassifyDepthSensor(MeasureDepthStatistics(depth));
  };
  EXPECT_EQ(classify(Wall()), DepthSensor::kStructuredLight);  // exact
  EXPECT_EQ(classify(Disturbed(Wall(), 0.0, TimeOfFlight)), DepthSensor::kTimeOfFlight);
  EXPECT_EQ(classify(Disturbed(Wall(), 4.0, Disparity)), DepthSensor::kStereo);
  EXPECT_EQ(classify(Disturbed(Wall(), 8.0, TimeOfFlight)), DepthSensor::kLidar);
  // Structured light whose steps were interpolated away.
  EXPECT_EQ(classify(Disturbed(Wall(), 0.6, Disparity)), DepthSensor::kStructuredLight);
  const auto quantized = [](double z, double noise) {
    return 1.0 / (0.003 * std::round((1.0 / z + 0.001 * noise) / 0.003));
  };
  EXPECT_EQ(classify(Disturbed(Wall(), 1.5, quantized)), DepthSensor::kStructuredLight);
  // Rounded to millimetres, a time-of-flight camera remains one.
  EXPECT_EQ(classify(Disturbed(Disturbed(Wall(), 0.0, TimeOfFlight), 0.0,
                               [](double z, double) { return 1e-3 * std::round(1e3 * z); })),
            DepthSensor::kTimeOfFlight);
}

TEST(ClassifyDepthSensor, ExactDepthThatWasWarpedToAnotherCameraIsNoStereo) {
  // The nearest pixel of an image that is smaller by a sixth: steps on every slanted surface.
  cv::Mat warped;
  cv::resize(Wall(), warped, cv::Size(), 1.2, 1.2, cv::INTER_NEAREST);
  EXPECT_EQ(ClassifyDepthSensor(MeasureDepthStatistics(warped)), DepthSensor::kStructuredLight);
}

TEST(ClassifyDepthSensor, IsUndecidedIfTheImageDoesNotTell) {
  const cv::Mat flat(kWallHeight, kWallWidth, CV_32FC1, cv::Scalar(2.0));
  EXPECT_EQ(ClassifyDepthSensor(MeasureDepthStatistics(Disturbed(flat.clone(), 0.0, TimeOfFlight))),
            DepthSensor::kAuto);

  const cv::Mat none = cv::Mat::zeros(kWallHeight, kWallWidth, CV_32FC1);
  EXPECT_EQ(ClassifyDepthSensor(MeasureDepthStatistics(none)), DepthSensor::kAuto);
}

}  // namespace
}  // namespace msc_vo
