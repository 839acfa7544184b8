// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/byte_order.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/rendered_depth.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

cv::Mat SwapBytes(const cv::Mat& raw) {
  cv::Mat swapped = raw.clone();
  for (auto p = swapped.begin<uint16_t>(); p != swapped.end<uint16_t>(); ++p) {
    *p = static_cast<uint16_t>(*p << 8 | *p >> 8);
  }
  return swapped;
}

// Evidence of raw images with `units` per metre.
ByteOrder Evidence(const std::vector<cv::Mat>& images, double units) {
  ByteOrder order;
  for (const cv::Mat& raw : images) {
    cv::Mat metres;
    raw.convertTo(metres, CV_32F, 1.0 / units);
    order.Add(metres, units);
  }
  return order;
}

// Expects that the images are recognised in both orders.
void ExpectRecognised(const std::vector<cv::Mat>& metres, double units, const std::string& name) {
  std::vector<cv::Mat> right, swapped;
  for (const cv::Mat& image : metres) {
    right.push_back(RoundedTo(units, image));
    swapped.push_back(SwapBytes(right.back()));
  }
  const ByteOrder of_right = Evidence(right, units), of_swapped = Evidence(swapped, units);
  EXPECT_FALSE(of_right.IsSwapped()) << name << ": " << of_right.SwappedRatio();
  EXPECT_TRUE(of_swapped.IsSwapped()) << name << ": " << of_swapped.SwappedRatio();
}

std::vector<cv::Mat> Changed(std::vector<cv::Mat> images,
                             const std::function<float(float)>& change) {
  for (cv::Mat& image : images) {
    image = image.clone();
    for (auto z = image.begin<float>(); z != image.end<float>(); ++z) *z = change(*z);
  }
  return images;
}

TEST(ByteOrder, IsRecognisedInEverySceneOfEverySensorInEveryUnit) {
  for (const SceneKind scene : {SceneKind::kRoom, SceneKind::kCorridor, SceneKind::kSlanted}) {
    for (const SyntheticDepth sensor :
         {SyntheticDepth::kExact, SyntheticDepth::kStructuredLight, SyntheticDepth::kTimeOfFlight,
          SyntheticDepth::kStereo, SyntheticDepth::kLidar}) {
      const std::vector<cv::Mat> images = RenderDepth(scene, sensor, 2);
      for (const double units : {10.0, 100.0, 256.0, 1000.0, 5000.0, 6553.5, 10000.0}) {
        ExpectRecognised(images, units,
                         std::to_string(static_cast<int>(scene)) + ", sensor " +
                             std::to_string(static_cast<int>(sensor)) + ", " +
                             std::to_string(units));
      }
    }
  }
}

TEST(ByteOrder, IsRecognisedInUnusualDepth) {
  const std::vector<cv::Mat> images =
      RenderDepth(SceneKind::kRoom, SyntheticDepth::kStructuredLight, 2);
  cv::RNG random(1);
  const auto sparse = Changed(images, [&](float z) { return random.uniform(0, 100) < 1 ? z : 0; });
  ExpectRecognised(sparse, 1000.0, "one of a hundred pixels");
  const auto narrow = Changed(images, [](float z) { return 1.0f + 0.03f * z; });
  ExpectRecognised(narrow, 1000.0, "a range of 0.1 m");
  const auto near = Changed(images, [](float z) { return 0.2f * z; });
  ExpectRecognised(near, 100.0, "less than 256 units");
  const auto levels = Changed(images, [](float z) { return 0.25f * std::round(4.0f * z); });
  ExpectRecognised(levels, 1000.0, "levels of 250 units");
  ExpectRecognised(levels, 5000.0, "levels of 1250 units");
}

TEST(ByteOrder, IsNotSeenInOneByteAlone) {
  // Eight bits in the high byte: the unit shows that they belong there.
  const std::vector<cv::Mat> images = RenderDepth(SceneKind::kRoom, SyntheticDepth::kExact, 1);
  const auto high = Changed(images, [](float z) { return 0.256f * std::round(z / 0.256f); });
  EXPECT_FALSE(Evidence({RoundedTo(1000.0, high[0])}, 1000.0).IsSwapped());
}

TEST(ByteOrder, IsNotSeenInNoiseNorInNothing) {
  cv::Mat noise(240, 320, CV_16UC1);
  cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 65536);
  EXPECT_FALSE(Evidence({noise}, 5000.0).IsSwapped());
  EXPECT_NEAR(Evidence({noise}, 5000.0).SwappedRatio(), 0.5, 0.02);
  EXPECT_FALSE(Evidence({cv::Mat::zeros(240, 320, CV_16UC1)}, 5000.0).IsSwapped());
  EXPECT_FALSE(Evidence({}, 5000.0).IsSwapped());
}

}  // namespace
}  // namespace msc_vo
