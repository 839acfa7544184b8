// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/depth_preparation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using S = SensorCorrection;

const PinholeCamera kSmallCamera{260.0, 260.0, 159.5, 119.5, 320, 240};
constexpr double kDepthDelay = 0.02;  // seconds
constexpr float kFar = 2.0f;
constexpr float kNear = 1.0f;

std::shared_ptr<const CameraIntrinsics> Given() {
  return std::make_shared<CameraIntrinsics>(CameraIntrinsics{kSmallCamera, {}});
}

// A wall whose part from column `edge` on is nearer.
RgbdImage ImageWithEdge(int edge) {
  RgbdImage image;
  image.id = 7;
  image.timestamp = 3.5;
  image.gray = cv::Mat(kSmallCamera.height, kSmallCamera.width, CV_8UC1, cv::Scalar(128));
  image.depth = cv::Mat(kSmallCamera.height, kSmallCamera.width, CV_32FC1, cv::Scalar(kFar));
  image.depth.colRange(edge, kSmallCamera.width).setTo(kNear);
  return image;
}

RgbdImage DelayedImageWithEdge(int edge, double delay) {
  RgbdImage image = ImageWithEdge(edge);
  image.depth_delay = delay;
  return image;
}

// What the image shows moves to the left by so many pixels within kDepthDelay.
CameraVelocity LeftBy(double pixels) {
  return {{0.0, -pixels / kSmallCamera.fx / kDepthDelay, 0.0}, {0.0, 0.0, 0.0}};
}

// The depth of the middle row begins to be that of the near part at column `edge`, up to two.
void ExpectEdge(const cv::Mat& depth, int edge) {
  ASSERT_EQ(depth.size(), cv::Size(kSmallCamera.width, kSmallCamera.height));
  EXPECT_NEAR(depth.at<float>(kSmallCamera.height / 2, edge - 3), kFar, 0.05);
  EXPECT_NEAR(depth.at<float>(kSmallCamera.height / 2, edge + 2), kNear, 0.05);
}

S::Vector ShiftBy(double pixels) {
  S::Vector correction = S::Vector::Zero();
  correction(S::kDepthX) = pixels / kSmallCamera.fx;
  return correction;
}

TEST(DepthPreparation, MovesDepthToTheTimeOfTheColourImage) {
  const DepthPreparation preparation(Given());
  const RgbdImage after = DelayedImageWithEdge(165, kDepthDelay);
  const RgbdImage aligned = preparation.Align(after, LeftBy(6.0));
  ExpectEdge(aligned.depth, 171);
  EXPECT_EQ(aligned.depth_delay, kDepthDelay);
  ASSERT_TRUE(aligned.depth_velocity);
  EXPECT_EQ(aligned.depth_velocity->linear, LeftBy(6.0).linear);
  EXPECT_EQ(aligned.id, 7);
  EXPECT_EQ(aligned.timestamp, 3.5);
  EXPECT_EQ(aligned.gray.data, after.gray.data);
  ExpectEdge(after.depth, 165);
  ExpectEdge(preparation.Align(DelayedImageWithEdge(165, -kDepthDelay), LeftBy(6.0)).depth, 159);
}

TEST(DepthPreparation, KeepsDepthThatNeedsNoAlignment) {
  const DepthPreparation preparation(Given());
  const RgbdImage simultaneous = ImageWithEdge(165);
  EXPECT_EQ(preparation.Align(simultaneous, LeftBy(6.0)).depth.data, simultaneous.depth.data);
  const RgbdImage delayed = DelayedImageWithEdge(165, kDepthDelay);
  const RgbdImage unknown_velocity = preparation.Align(delayed, std::nullopt);
  EXPECT_EQ(unknown_velocity.depth.data, delayed.depth.data);
  EXPECT_FALSE(unknown_velocity.depth_velocity);
  const RgbdImage hardly_moved = preparation.Align(delayed, LeftBy(0.3));
  EXPECT_EQ(hardly_moved.depth.data, delayed.depth.data);
  ASSERT_TRUE(hardly_moved.depth_velocity);
  EXPECT_TRUE(hardly_moved.depth_velocity->linear.isZero());
}

// Depth images that are not registered are aligned before they are: with the camera that took them.
TEST(DepthPreparation, AlignsWithTheCameraThatTookTheDepth) {
  DepthPreparation preparation(Given());
  S::Vector correction = S::Vector::Zero();
  correction(S::kFocalLength) = std::log(1.5);
  preparation.SetIntrinsics(Corrected(*Given(), correction));
  const RgbdImage image = DelayedImageWithEdge(165, kDepthDelay);
  ExpectEdge(preparation.Align(image, LeftBy(6.0)).depth, 174);
  correction(S::kDepthFocalLength) = std::log(2.0);
  preparation.SetIntrinsics(Corrected(*Given(), correction));
  ExpectEdge(preparation.Align(image, LeftBy(6.0)).depth, 183);
}

TEST(DepthPreparation, RegistersDepthOnlyIfTheIntrinsicsSaySo) {
  DepthPreparation preparation(Given());
  const RgbdImage image = ImageWithEdge(172);
  EXPECT_EQ(preparation.Register(image).depth.data, image.depth.data);
  preparation.SetIntrinsics(Corrected(*Given(), ShiftBy(12.0)));
  const RgbdImage registered = preparation.Register(image);
  ExpectEdge(registered.depth, 160);
  EXPECT_EQ(registered.gray.data, image.gray.data);
  EXPECT_EQ(registered.timestamp, image.timestamp);
  ExpectEdge(image.depth, 172);
  S::Vector correction = S::Vector::Zero();
  correction(S::kFocalLength) = 0.1;
  preparation.SetIntrinsics(Corrected(*Given(), correction));
  EXPECT_EQ(preparation.Register(image).depth.data, image.depth.data);
}

// A registration is a map from colour to depth pixels, whatever the focal length of both.
TEST(DepthPreparation, RegistersRelativeToTheGivenIntrinsics) {
  DepthPreparation preparation(Given());
  S::Vector correction = ShiftBy(12.0);
  correction(S::kFocalLength) = std::log(1.5);
  preparation.SetIntrinsics(Corrected(*Given(), correction));
  ExpectEdge(preparation.Register(ImageWithEdge(232)).depth, 220);
  EXPECT_EQ(preparation.given()->camera.fx, kSmallCamera.fx);
}

TEST(DepthPreparation, MeasuresDepthAgainWithAnyRegistration) {
  const auto given = Given();
  auto preparation = std::make_unique<DepthPreparation>(given);
  const DepthMeasurement measure = preparation->MeasurementFor(FrameBuilderOptions());
  preparation.reset();
  Frame frame;
  frame.camera = kSmallCamera;
  frame.intrinsics = given;
  frame.points.resize(2);
  frame.points[0].pixel = {140.0, 120.0};
  frame.points[1].pixel = {185.0, 120.0};
  const RgbdImage image = ImageWithEdge(172);
  const RecordedImage recorded(image.gray, image.depth, DepthSensor::kStructuredLight);
  for (const double shift : {12.0, -28.0, 12.0}) {  // the edge is at column 160, 200, 160
    const auto corrected = std::make_shared<CameraIntrinsics>(Corrected(*given, ShiftBy(shift)));
    const std::shared_ptr<const Frame> measured = measure(frame, recorded, corrected);
    EXPECT_EQ(measured->intrinsics, corrected);
    EXPECT_NEAR(measured->points[0].inverse_depth, 1.0 / kFar, 1e-3);
    EXPECT_NEAR(measured->points[1].inverse_depth, shift > 0.0 ? 1.0 / kNear : 1.0 / kFar, 1e-3);
    EXPECT_GT(measured->points[1].inverse_depth_sigma, 0.0);
  }
}

// The correction of a registration is taken back.
TEST(DepthPreparation, MeasuresDepthAgainWithoutARegistration) {
  const auto given = Given();
  const DepthMeasurement measure = DepthPreparation(given).MeasurementFor(FrameBuilderOptions());
  Frame frame;
  frame.camera = kSmallCamera;
  frame.intrinsics = std::make_shared<CameraIntrinsics>(Corrected(*given, ShiftBy(-28.0)));
  frame.points.resize(2);
  frame.points[0].pixel = {140.0, 120.0};
  frame.points[1].pixel = {185.0, 120.0};
  const RgbdImage image = ImageWithEdge(172);
  const auto measured =
      measure(frame, RecordedImage(image.gray, image.depth, DepthSensor::kStructuredLight), given);
  EXPECT_EQ(measured->intrinsics, given);
  EXPECT_NEAR(measured->points[0].inverse_depth, 1.0 / kFar, 1e-3);
  EXPECT_NEAR(measured->points[1].inverse_depth, 1.0 / kNear, 1e-3);
}

// The sensor cannot be inferred from a reduced image.
TEST(DepthPreparation, MeasuresDepthAgainWithTheSensorOfTheRun) {
  const auto given = Given();
  const RgbdImage image = ImageWithEdge(172);
  const auto corrected = std::make_shared<CameraIntrinsics>(Corrected(*given, ShiftBy(12.0)));
  Frame frame;
  frame.camera = kSmallCamera;
  frame.intrinsics = given;
  frame.points.resize(1);
  frame.points[0].pixel = {80.0, 120.0};
  std::vector<double> sigmas;
  for (const DepthSensor sensor : {DepthSensor::kStructuredLight, DepthSensor::kStereo}) {
    FrameBuilderOptions options;
    const RecordedImage recorded(image.gray, image.depth, sensor);
    const auto measured =
        DepthPreparation(given).MeasurementFor(options)(frame, recorded, corrected);
    sigmas.push_back(measured->points[0].inverse_depth_sigma);
  }
  EXPECT_GT(sigmas[1], 1.1 * sigmas[0]);
}

}  // namespace
}  // namespace msc_vo
