// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/lens_remap.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "tests/features/distortion.h"
#include "tests/features/drawing.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/features/line_extractor.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

TEST(LensRemap, IsIdentityWithoutDistortion) {
  const LensRemap lens(testing::Freiburg1Camera(), LensDistortion());
  const cv::Mat image(480, 640, CV_8UC1, cv::Scalar(3));
  EXPECT_EQ(lens.Undistort(image).data, image.data);
  EXPECT_TRUE(lens.mask().empty());
  EXPECT_EQ(lens.RawFromIdeal({12.5, 300.25}), Vector2d(12.5, 300.25));
  EXPECT_EQ(lens.IdealFromRaw({12.5, 300.25}), Vector2d(12.5, 300.25));
}

TEST(LensRemap, UndistortionInvertsDistortion) {
  const LensRemap lens(testing::Freiburg1Camera(), testing::Freiburg1Distortion());
  double largest = 0.0;
  for (int y = 0; y < 480; y += 60) {
    for (int x = 0; x < 640; x += 60) {
      const Vector2d ideal(x, y);
      const Vector2d raw = lens.RawFromIdeal(ideal);
      EXPECT_LT((lens.IdealFromRaw(raw) - ideal).norm(), 1e-6);
      largest = std::max(largest, (raw - ideal).norm());
    }
  }
  EXPECT_GT(largest, 5.0);  // the distortion is significant
}

TEST(LensRemap, MaskCoversRawImage) {
  LensDistortion barrel;  // the borders of the raw image lie inside the ideal image
  barrel.k[0] = 0.3;
  const LensRemap lens(testing::Freiburg1Camera(), barrel);
  ASSERT_EQ(lens.mask().size(), cv::Size(640, 480));
  EXPECT_EQ(lens.mask().at<uint8_t>(240, 320), 255);
  EXPECT_EQ(lens.mask().at<uint8_t>(0, 0), 0);
}

// Bilinear interpolation with positions rounded to 32nds of a pixel, beyond the border, too.
TEST(LensRemap, InterpolatesAsOpenCvDoes) {
  LensDistortion barrel;
  barrel.k[0] = 0.3;
  for (const LensDistortion& distortion : {barrel, testing::Freiburg1Distortion()}) {
    const PinholeCamera camera = testing::Freiburg1Camera();
    cv::Mat wide(camera.height, camera.width + 7, CV_8UC1), expected;
    cv::RNG(3).fill(wide, cv::RNG::UNIFORM, 0, 256);
    const cv::Mat raw = wide.colRange(0, camera.width);  // not contiguous
    cv::Mat map(raw.size(), CV_32FC2);
    for (int y = 0; y < camera.height; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        map.at<cv::Vec2f>(y, x) = cv::Vec2d(distortion.Distort(camera, Vector2d(x, y)).data());
      }
    }
    cv::remap(raw, expected, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    const cv::Mat ideal = LensRemap(camera, distortion).Undistort(raw);
    EXPECT_EQ(cv::norm(ideal, expected, cv::NORM_INF), 0.0);
    cv::Mat color, expected_color;
    cv::merge(std::vector<cv::Mat>{raw, 255 - raw, raw}, color);
    cv::remap(color, expected_color, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    EXPECT_EQ(cv::norm(LensRemap(camera, distortion).Undistort(color), expected_color), 0.0);
    EXPECT_THROW(LensRemap(camera, distortion).Undistort(wide), std::invalid_argument);
  }
}

TEST(LensRemap, UndistortsImagesOfOnePixel) {
  LensDistortion barrel;
  barrel.k[0] = 0.3;
  const cv::Mat raw(1, 1, CV_8UC1, cv::Scalar(7));
  const cv::Mat ideal = LensRemap({1.0, 1.0, 0.5, 0.5, 1, 1}, barrel).Undistort(raw);
  EXPECT_EQ(ideal.at<uint8_t>(0, 0), 7);
}

TEST(LensRemap, UndistortsStraightLines) {
  const PinholeCamera camera = testing::Freiburg1Camera();
  // A long edge near the upper border, where the lens bends it by pixels.
  const LineSegment2 truth{Vector2d(30.0, 25.3), Vector2d(610.0, 40.7)};
  testing::Canvas canvas(camera.width, camera.height, 60);
  const Vector2d d = (truth.end - truth.start) / 580.0;
  canvas.FillPolygon({truth.start - 60.0 * d, truth.end + 60.0 * d, {700.0, 500.0}, {-60.0, 500.0}},
                     180);
  const cv::Mat raw =
      testing::DistortImage(camera, testing::Freiburg1Distortion(), canvas.Render());
  const LensRemap lens(camera, testing::Freiburg1Distortion());
  LineExtractor extractor({});
  const auto undistorted = extractor.Extract(lens.Undistort(raw), lens.mask());
  ASSERT_FALSE(undistorted.empty());
  const LineSegment2 line = undistorted[0].segment;  // the longest
  EXPECT_GT(line.Length(), 500.0);
  EXPECT_LT(truth.DistanceToLine(line.start), 0.4);
  EXPECT_LT(truth.DistanceToLine(line.end), 0.4);
  // In the raw image the edge is curved and deviates from the detected line.
  const auto distorted = extractor.Extract(raw);
  ASSERT_FALSE(distorted.empty());
  double farthest = 0.0;
  for (double s = 0.0; s <= 1.0; s += 0.05) {
    const Vector2d on_edge = testing::Freiburg1Distortion().Distort(camera, Vector2d(truth.At(s)));
    const double t = distorted[0].segment.Parameter(on_edge);
    if (t < 0.0 || t > 1.0) continue;
    farthest = std::max(farthest, distorted[0].segment.DistanceToLine(on_edge));
  }
  EXPECT_GT(farthest, 0.8);
}

}  // namespace
}  // namespace msc_vo
