// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Images with a mask: nothing is detected on it or near it, and its depth is not used.

#include <cmath>

#include "tests/features/depth_images.h"
#include "tests/features/distortion.h"
#include "tests/features/drawing.h"
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/features/frame_builder.h"
#include "msc_vo/sensor/image_mask.h"

namespace msc_vo {
namespace {

using testing::kVgaCamera;

constexpr double kPointRadius = 19.0;  // of a descriptor on level 0, pixels
constexpr double kLineRadius = 36.0;   // half the width of a line's region

double FrontalWall(const Eigen::Vector2d& /*pixel*/) { return 0.5; }

RgbdImage Poster() {
  RgbdImage image;
  image.gray = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0, 2.0);
  image.depth = testing::DrawDepth(kVgaCamera, FrontalWall);
  return image;
}

// A rectangle and a disc.
cv::Mat Mask() {
  cv::Mat mask = cv::Mat::zeros(480, 640, CV_8UC1);
  mask(cv::Rect(400, 100, 180, 300)) = 1;
  cv::circle(mask, {150, 300}, 60, cv::Scalar(255), cv::FILLED);
  return mask;
}

double DistanceAt(const cv::Mat& distance, const Eigen::Vector2d& x) {
  return distance.at<float>(std::min(cvRound(x.y()), 479), std::min(cvRound(x.x()), 639));
}

void ExpectFarFromMask(const Frame& frame, const cv::Mat& distance) {
  for (const PointFeature& point : frame.points) {
    // Half a pixel of the level for its position.
    const double scale = std::pow(1.2, point.level);
    EXPECT_GT(DistanceAt(distance, point.pixel), (kPointRadius - 1.0) * scale - 1.0);
  }
  for (const LineFeature& line : frame.lines) {
    const double length = line.segment.Length();
    for (double s = 0.0; s <= length; s += 1.0) {
      EXPECT_GT(DistanceAt(distance, line.segment.At(s / length)), kLineRadius - 3.0);
    }
  }
}

TEST(MaskedImages, HaveNoFeatureNearTheMask) {
  RgbdImage image = Poster();
  FrameBuilder builder(FrameBuilderOptions(), kVgaCamera, LensDistortion());
  const cv::Mat distance = DistanceToMask(Mask());
  const Frame whole = builder.Build(image);
  int num_near = 0;
  for (const PointFeature& point : whole.points) num_near += DistanceAt(distance, point.pixel) < 19;
  ASSERT_GT(num_near, 100);  // the test can fail
  image.mask = Mask();
  const Frame frame = builder.Build(image);
  EXPECT_GT(frame.points.size(), 300u);
  EXPECT_GT(frame.lines.size(), 15u);
  ExpectFarFromMask(frame, distance);
  image.mask = cv::Mat();  // the mask of the image before is forgotten
  EXPECT_EQ(builder.Build(image).points.size(), whole.points.size());
}

TEST(MaskedImages, KeepBothPartsOfALineBehindTheMask) {
  RgbdImage image;
  image.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(60));
  image.gray(cv::Rect(0, 240, 640, 240)) = 180;  // one line from side to side
  image.depth = testing::DrawDepth(kVgaCamera, FrontalWall);
  image.mask = cv::Mat::zeros(480, 640, CV_8UC1);
  image.mask(cv::Rect(300, 200, 40, 80)) = 255;
  for (const LineDetector detector : {LineDetector::kEdgeDrawing, LineDetector::kLsd}) {
    FrameBuilderOptions options;
    options.lines.detector = detector;
    const Frame frame = FrameBuilder(options, kVgaCamera, LensDistortion()).Build(image);
    ASSERT_EQ(frame.lines.size(), 2u);
    for (const LineFeature& line : frame.lines) {
      const double end = std::max(line.segment.start.x(), line.segment.end.x());
      const double begin = std::min(line.segment.start.x(), line.segment.end.x());
      EXPECT_TRUE(end < 300.0 - kLineRadius + 2.0 || begin > 340.0 + kLineRadius - 2.0);
      EXPECT_GT(end - begin, 230.0);
    }
  }
}

TEST(MaskedImages, AreUndistortedWithTheirMask) {
  RgbdImage image = Poster();
  image.mask = Mask();
  const LensDistortion lens{{-0.2, 0.05}};
  FrameBuilder builder(FrameBuilderOptions(), kVgaCamera, lens);
  const Frame frame = builder.Build(image);
  EXPECT_GT(frame.lines.size(), 10u);
  const cv::Mat distance = DistanceToMask(Mask());
  for (const LineFeature& line : frame.lines) {
    for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Eigen::Vector2d raw = lens.Distort(kVgaCamera, line.segment.At(s));
      EXPECT_GT(DistanceAt(distance, raw), 0.7 * kLineRadius);  // the lens shrinks distances
    }
  }
}

TEST(MaskedImages, DoNotUseTheDepthOfTheMask) {
  RgbdImage image = Poster();
  image.mask = Mask();
  FrameBuilder builder(FrameBuilderOptions(), kVgaCamera, LensDistortion());
  const Frame frame = builder.Build(image);
  cv::Mat wrong = image.depth.clone();
  wrong.setTo(0.7f, image.mask);
  image.depth = wrong;
  const Frame other = builder.Build(image);
  ASSERT_EQ(frame.points.size(), other.points.size());
  for (size_t i = 0; i < frame.points.size(); ++i) {
    EXPECT_EQ(frame.points[i].inverse_depth, other.points[i].inverse_depth);
  }
  EXPECT_EQ(wrong.at<float>(200, 450), 0.7f);  // the pixels of the caller stay
  for (int row = 0; row < DepthRanges::kRows; ++row) {
    for (int column = 0; column < DepthRanges::kColumns; ++column) {
      EXPECT_EQ(frame.depth_ranges.At(column, row).max_inverse_depth,
                other.depth_ranges.At(column, row).max_inverse_depth);
    }
  }
}

TEST(MaskedImages, AreRefusedIfTheMaskDoesNotFit) {
  RgbdImage image = Poster();
  FrameBuilder builder(FrameBuilderOptions(), kVgaCamera, LensDistortion());
  image.mask = cv::Mat::zeros(240, 320, CV_8UC1);
  EXPECT_THROW(builder.Build(image), std::invalid_argument);
  image.mask = cv::Mat::zeros(480, 640, CV_32FC1);
  EXPECT_THROW(builder.Build(image), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
