// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/clipped_depth.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/support/rendered_depth.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr int kNumImages = 20;
using Change = std::function<float(float)>;

DepthLimits Find(const std::vector<cv::Mat>& images, const Change& change) {
  ClippedDepthFinder finder;
  for (const cv::Mat& image : images) {
    cv::Mat changed = image.clone();
    for (auto z = changed.begin<float>(); z != changed.end<float>(); ++z) {
      if (*z > 0.0f) *z = change(*z);
    }
    finder.Add(changed);
  }
  return finder.limits();
}

class ClippedDepthTest : public ::testing::TestWithParam<SyntheticDepth> {
 protected:
  // Rendered once for all tests.
  static const std::vector<cv::Mat>& Images() {
    static std::map<SyntheticDepth, std::vector<cv::Mat>> images;
    std::vector<cv::Mat>& of_sensor = images[GetParam()];
    if (of_sensor.empty()) of_sensor = RenderDepth(SceneKind::kRoom, GetParam(), kNumImages);
    return of_sensor;
  }
};

TEST_P(ClippedDepthTest, IsFoundAtEitherEndInEveryUnit) {
  for (const double units : {100.0, 1000.0, 5000.0}) {
    const auto round = [units](float z) { return static_cast<float>(std::round(z * units)); };
    for (const float end : {2.2f, 2.3f, 2.53f, 3.0f}) {
      const DepthLimits limits = Find(Images(), [&](float z) { return round(std::min(z, end)); });
      EXPECT_EQ(limits.farthest, round(end)) << units;
      EXPECT_FALSE(limits.HasNearest()) << units;
    }
    const DepthLimits limits = Find(Images(), [&](float z) { return round(std::max(z, 2.2f)); });
    EXPECT_EQ(limits.nearest, round(2.2f)) << units;
    EXPECT_FALSE(limits.HasFarthest()) << units;
  }
}

TEST_P(ClippedDepthTest, IsFoundAtBothEndsAndBelowAMark) {
  const DepthLimits both = Find(Images(), [](float z) { return std::clamp(z, 2.0f, 3.0f); });
  EXPECT_EQ(both.nearest, 2.0f);
  EXPECT_EQ(both.farthest, 3.0f);
  EXPECT_TRUE(both.Contain(2.5f));
  EXPECT_FALSE(both.Contain(3.0f));
  const DepthLimits mark = Find(Images(), [](float z) { return z > 2.5f ? 65.535f : z; });
  EXPECT_EQ(mark.farthest, 65.535f);
}

TEST_P(ClippedDepthTest, IsNotFoundInRoundedDepth) {
  for (const double step : {1e-4, 0.001, 0.01, 0.03}) {
    const DepthLimits limits = Find(Images(), [step](float z) {
      return static_cast<float>(step * std::max(1.0, std::round(z / step)));
    });
    EXPECT_FALSE(limits.HasNearest()) << step;
    EXPECT_FALSE(limits.HasFarthest()) << step;
  }
  // Disparity of a Kinect in steps of 1/8 and of 1/2 pixel.
  for (const double step : {0.125, 0.5}) {
    const DepthLimits limits = Find(Images(), [step](float z) {
      return static_cast<float>(40.0 / (step * std::max(1.0, std::round(40.0 / z / step))));
    });
    EXPECT_FALSE(limits.HasNearest()) << step;
    EXPECT_FALSE(limits.HasFarthest()) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Sensors, ClippedDepthTest,
                         ::testing::Values(SyntheticDepth::kExact, SyntheticDepth::kStructuredLight,
                                           SyntheticDepth::kStereo));

// A wall that fills the right half of the image, with a floor that ends at it.
cv::Mat RoomWithWall(double distance) {
  cv::Mat depth(240, 320, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double floor = y <= 120 ? distance : 1.3 * 300.0 / (y - 120);
      const double side = x >= 160 ? distance : 0.9 * 300.0 / (160 - x);
      depth.at<float>(y, x) =
          static_cast<float>(std::round(1000.0 * std::min({distance, floor, side})));
    }
  }
  return depth;
}

TEST(ClippedDepth, IsNotAWallThatTheCameraFaces) {
  ClippedDepthFinder resting;
  for (int i = 0; i < kNumImages; ++i) EXPECT_FALSE(resting.Add(RoomWithWall(3.0)));
  ClippedDepthFinder moving;
  for (int i = 0; i < kNumImages; ++i) EXPECT_FALSE(moving.Add(RoomWithWall(3.0 - 0.05 * i)));
  ClippedDepthFinder returning;
  for (int i = 0; i < kNumImages; ++i) {
    EXPECT_FALSE(returning.Add(RoomWithWall(3.0 - 0.2 * std::abs(std::sin(0.7 * i)))));
  }
}

TEST(ClippedDepth, IsNotSeenInNothing) {
  ClippedDepthFinder finder;
  EXPECT_FALSE(finder.Add(cv::Mat::zeros(240, 320, CV_32FC1)));
  EXPECT_FALSE(finder.Add(cv::Mat(240, 320, CV_32FC1, cv::Scalar(2.0))));
  EXPECT_FALSE(finder.Add(cv::Mat(2, 2, CV_32FC1, cv::Scalar(2.0))));
  EXPECT_FALSE(finder.Add(cv::Mat()));
}

TEST(DepthLimits, ApplyToDepthOfEitherType) {
  const DepthLimits limits{2.0f, 4.0f};
  for (const int type : {CV_16UC1, CV_32FC1}) {
    cv::Mat depth = cv::Mat((cv::Mat_<float>(1, 6) << 0, 1, 2, 3, 4, 5));
    depth.convertTo(depth, type);
    limits.Apply(&depth);
    depth.convertTo(depth, CV_32F);
    EXPECT_EQ(cv::norm(depth, cv::Mat((cv::Mat_<float>(1, 6) << 0, 0, 0, 3, 0, 0))), 0.0);
  }
}

}  // namespace
}  // namespace msc_vo
