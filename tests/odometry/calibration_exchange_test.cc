// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/calibration_exchange.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

class CalibrationExchangeTest : public testing::Test {
 protected:
  CalibrationExchangeTest() {
    image_.aligned.gray = cv::Mat(camera_.height, camera_.width, CV_8UC1, cv::Scalar(90));
    image_.aligned.depth = cv::Mat(camera_.height, camera_.width, CV_32FC1, cv::Scalar(2.0));
    image_.recorded = image_.aligned;
  }
  static TrackedFrame FrameAt(double timestamp) {
    auto frame = std::make_shared<Frame>();
    frame->timestamp = timestamp;
    TrackedFrame tracked;
    tracked.frame = frame;
    tracked.status = TrackingStatus::kTracked;
    return tracked;
  }
  // Frames at 50 Hz from 1 to `end` seconds, then the packet of a keyframe.
  KeyframePacket Run(double end, CalibrationExchange* exchange) {
    for (double time = 1.0; time < end; time += 0.02) {
      exchange->KeepImage(FrameAt(time), image_, map_);
    }
    return Keyframe(end, exchange);
  }
  KeyframePacket Keyframe(double timestamp, CalibrationExchange* exchange) {
    KeyframePacket packet;
    packet.frame = FrameAt(timestamp).frame;
    exchange->AddImages(image_, map_, &packet);
    return packet;
  }

  PinholeCamera camera_;
  AlignedImage image_;
  MapSnapshot map_;
  static OdometryOptions Options() {
    OdometryOptions options;
    options.features.depth_sensor = DepthSensor::kTimeOfFlight;
    return options;
  }
  ImagePipeline images_{Options(), camera_, LensDistortion()};
  Mapper mapper_{MapperOptions()};
};

TEST_F(CalibrationExchangeTest, PassesAFewImagesBetweenKeyframes) {
  CalibrationExchange exchange(true, &images_, &mapper_);
  const KeyframePacket packet = Run(1.3, &exchange);
  EXPECT_NE(packet.image, nullptr);
  ASSERT_GE(packet.calibration_images.size(), 2u);
  double last = 0.0;
  for (const CalibrationImage& image : packet.calibration_images) {
    EXPECT_GT(image.frame->timestamp - last, 0.11);
    last = image.frame->timestamp;
  }
  EXPECT_EQ(packet.image->sensor(), DepthSensor::kTimeOfFlight);
  EXPECT_LE(Run(9.0, &exchange).calibration_images.size(), 3u);
  EXPECT_TRUE(Keyframe(9.1, &exchange).calibration_images.empty());
}

TEST_F(CalibrationExchangeTest, KeepsOnlyTrackedFramesThatAreNoKeyframes) {
  CalibrationExchange exchange(true, &images_, &mapper_);
  TrackedFrame weak = FrameAt(1.0), keyframe = FrameAt(2.0);
  weak.status = TrackingStatus::kWeak;
  keyframe.keyframe.id = 0;
  exchange.KeepImage(weak, image_, map_);
  exchange.KeepImage(keyframe, image_, map_);
  EXPECT_TRUE(Keyframe(2.0, &exchange).calibration_images.empty());
}

TEST_F(CalibrationExchangeTest, PassesNoImagesThatAreNotNeeded) {
  CalibrationExchange disabled(false, &images_, &mapper_);
  EXPECT_EQ(Run(1.5, &disabled).image, nullptr);
  CalibrationExchange exchange(true, &images_, &mapper_);
  map_.calibration_is_settled = true;
  const KeyframePacket packet = Run(1.5, &exchange);
  EXPECT_EQ(packet.image, nullptr);
  EXPECT_TRUE(packet.calibration_images.empty());
}

TEST_F(CalibrationExchangeTest, ExtractsAFrameAgainIfTheMapHasAnotherCalibration) {
  CalibrationExchange exchange(true, &images_, &mapper_);
  StageTimes times;
  const ExtractedFrame extracted = images_.Extract(image_, &times);
  const auto adopt = [&] { return exchange.Adopt(map_, image_, extracted, &times).frame; };
  EXPECT_EQ(adopt(), extracted.frame);  // the map knows none
  auto corrected = std::make_shared<CameraIntrinsics>(*images_.intrinsics());
  corrected->camera.fx *= 1.01;
  map_.intrinsics = corrected;
  const std::shared_ptr<const Frame> again = adopt();
  EXPECT_NE(again, extracted.frame);
  EXPECT_EQ(again->camera.fx, corrected->camera.fx);
  EXPECT_EQ(adopt(), extracted.frame);  // in use already
  OdometryResult result;
  exchange.Describe(&result);
  EXPECT_FALSE(result.calibration.IsCorrected());  // the estimator has accepted none
}

}  // namespace
}  // namespace msc_vo
