// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr double kNoise = 10.0;  // grey values

// An image of boxes in front of a wall.
struct BoxImage {
  cv::Mat gray;
  cv::Mat depth;
};

// Fraction of the interval [i, i + 1] that is beyond `begin`.
double Covered(int i, double begin) { return std::clamp(i + 1.0 - begin, 0.0, 1.0); }

// Boxes that leave the image at its lower right: only their left and upper edges are visible, at
// depths 2.5, 2, ... metres. `shift`: of the depth image, pixels; the grey image is antialiased, so
// that the shift may be a fraction.
BoxImage MakeBoxes(const cv::Size& size, const Eigen::Vector2d& shift) {
  BoxImage image{cv::Mat(size, CV_8UC1, cv::Scalar(200)), cv::Mat(size, CV_32FC1, cv::Scalar(3))};
  cv::RNG random(1);
  for (int box = 0; box < 4; ++box) {
    // Even and odd pixels.
    const int left = size.width * (2 + 3 * box) / 16 + box, top = size.height * (3 + 3 * box) / 16;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const double covered = Covered(x, left - shift.x()) * Covered(y, top - shift.y());
        auto& gray = image.gray.at<uint8_t>(y, x);
        gray = cv::saturate_cast<uint8_t>(gray + covered * (150 - 35 * box - gray));
        if (x >= left && y >= top) image.depth.at<float>(y, x) = 2.5f - 0.5f * box;
      }
    }
  }
  for (auto gray = image.gray.begin<uint8_t>(); gray != image.gray.end<uint8_t>(); ++gray) {
    *gray = cv::saturate_cast<uint8_t>(*gray + random.gaussian(kNoise));
  }
  return image;
}

Eigen::Vector2d FoundShift(const BoxImage& image) {
  return FindPeak(AlignEdges(image.gray, image.depth, false)).shift;
}

class EdgeAlignmentTest : public testing::TestWithParam<cv::Size> {};

TEST_P(EdgeAlignmentTest, FindsNoShiftOfRegisteredDepth) {
  const Eigen::Vector2d found = FoundShift(MakeBoxes(GetParam(), {0.0, 0.0}));
  EXPECT_LT(found.norm(), 0.3) << found.transpose();
}

TEST_P(EdgeAlignmentTest, FindsTheShiftOfDepth) {
  const double tolerance = 0.4 * std::max(1.0, GetParam().width / 640.0);
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(2.0, 0.0), Eigen::Vector2d(0.0, -3.0), Eigen::Vector2d(-1.5, 1.0)}) {
    const Eigen::Vector2d found = FoundShift(MakeBoxes(GetParam(), shift));
    EXPECT_LT((found + shift).norm(), tolerance)
        << found.transpose() << " for " << shift.transpose();
  }
}

TEST_P(EdgeAlignmentTest, FindsALargeShiftToAStep) {
  const int width = GetParam().width;
  const Eigen::Vector2d shift(-width / 40, width / 32);
  const Eigen::Vector2d found = FoundShift(MakeBoxes(GetParam(), shift));
  EXPECT_LT((found + shift).norm(), std::max(1.0, width / 320.0))
      << found.transpose() << " for " << shift.transpose();
}

INSTANTIATE_TEST_SUITE_P(Sizes, EdgeAlignmentTest,
                         testing::Values(cv::Size(320, 240), cv::Size(512, 424), cv::Size(640, 480),
                                         cv::Size(848, 480), cv::Size(1280, 720)));

}  // namespace
}  // namespace msc_vo
