// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/loss_cause.h"

#include <functional>
#include <map>
#include <optional>

#include "tests/support/rendered_images.h"
#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::Not;
using testing::StartsWith;

constexpr int kMinFeatures = 20;

// A good image whose features do not fit the map.
FrameResult Unmatched() {
  FrameResult frame;
  frame.num_points = 800;
  frame.num_lines = 90;
  frame.num_with_depth = 700;
  frame.image = {110.0, 50.0, 0.8};
  return frame;
}

TEST(FindLossCause, ReturnsTheFirstCauseThatApplies) {
  FrameResult frame = Unmatched();
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kNoMatch);
  frame.num_with_depth = 3;
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kDepthOutOfRange);
  frame.image.measured_depth = 0.0;
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kNoDepth);
  frame.num_points = frame.num_lines = 4;
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kFewFeatures);
  frame.image.contrast = 0.5;
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kUniformImage);
}

TEST(FindLossCause, ComparesWithTheFeaturesThatAMapNeeds) {
  const FrameResult frame = Unmatched();
  EXPECT_EQ(FindLossCause(frame, 701, false), LossCause::kDepthOutOfRange);
  EXPECT_EQ(FindLossCause(frame, 891, false), LossCause::kFewFeatures);
}

TEST(FindLossCause, IsThatOfFramesThatAreNotTracked) {
  FrameResult frame = Unmatched();
  frame.status = TrackingStatus::kTracked;
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), std::nullopt);
  for (const TrackingStatus status :
       {TrackingStatus::kWeak, TrackingStatus::kPredicted, TrackingStatus::kLost}) {
    frame.status = status;
    EXPECT_EQ(FindLossCause(frame, kMinFeatures, false), LossCause::kNoMatch);
    EXPECT_EQ(FindLossCause(frame, kMinFeatures, true), LossCause::kImplausible);
  }
  frame.num_with_depth = 3;  // explains more
  EXPECT_EQ(FindLossCause(frame, kMinFeatures, true), LossCause::kDepthOutOfRange);
}

TEST(DescribeLossCause, SuitsOneImageAndSeveral) {
  for (int i = 0; i < kNumLossCauses; ++i) {
    EXPECT_THAT(Describe(static_cast<LossCause>(i)),
                AllOf(Not(StartsWith("that ")), Not(StartsWith("unknown"))));
  }
}

class FrameCauseTest : public RoomTest {
 protected:
  static std::vector<std::optional<LossCause>> Causes(const OdometryOptions& options,
                                                      const std::vector<RgbdImage>& images) {
    Odometry odometry(options, camera_, LensDistortion());
    std::vector<std::optional<LossCause>> causes;
    for (const RgbdImage& image : images) causes.push_back(odometry.Process(image).cause);
    causes.push_back(odometry.Drop(1000, 1000.0).cause);
    return causes;
  }
};

// The view of another place, with the time stamp of `image`.
RgbdImage ElsewhereInsteadOf(const RgbdImage& image) {
  RgbdImage other = image;
  cv::resize(cv::Mat(image.gray.t()), other.gray, image.gray.size());
  return other;
}

TEST_F(FrameCauseTest, ComesWithTheResultOfTheFrame) {
  std::vector<RgbdImage> images(images_->begin(), images_->begin() + 24);
  std::map<size_t, LossCause> expected;
  const auto spoil = [&](size_t i, LossCause cause, const std::function<void(RgbdImage*)>& change) {
    images[i] = ElsewhereInsteadOf(images[i]);
    change(&images[i]);
    expected[i] = cause;
  };
  spoil(4, LossCause::kUniformImage, [](RgbdImage* image) { Cover(image); });
  spoil(8, LossCause::kFewFeatures, [](RgbdImage* image) {
    cv::GaussianBlur(image->gray, image->gray, cv::Size(), 40.0);  // pixels
  });
  spoil(12, LossCause::kNoDepth,
        [](RgbdImage* image) { image->depth = cv::Mat::zeros(image->depth.size(), CV_32FC1); });
  spoil(16, LossCause::kDepthOutOfRange,
        [](RgbdImage* image) { image->depth = 50.0 * image->depth; });
  spoil(20, LossCause::kNoMatch, [](RgbdImage*) {});
  OdometryOptions options;
  options.features.extract_planes = false;  // most of these depth images show where the camera is
  const auto causes = Causes(options, images);
  for (size_t i = 0; i < images.size(); ++i) {
    const auto cause = expected.find(i);
    EXPECT_EQ(causes[i], cause != expected.end() ? std::optional(cause->second) : std::nullopt)
        << i;
  }
}

TEST_F(FrameCauseTest, IsGivenForWeakFrames) {
  OdometryOptions options;
  options.tracking.weak_translation_sigma = 1e-6;  // metres
  const std::vector<RgbdImage> images(images_->begin(), images_->begin() + 5);
  const auto causes = Causes(options, images);
  for (int i = 1; i < 5; ++i) EXPECT_EQ(causes[i], LossCause::kNoMatch) << i;
  EXPECT_EQ(causes[0], std::nullopt);
  EXPECT_EQ(causes[5], std::nullopt);  // dropped
}

}  // namespace
}  // namespace msc_vo
