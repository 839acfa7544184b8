// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/edge_alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "msc_vo/diagnosis/sequence_findings.h"

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

// A rectangle at another depth than its surroundings. Lengths are fractions of the image.
struct Rectangle {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
  float depth = 0.0f;
  int gray = 0;
};

// Rectangles with all four edges in the image, in front of a wall at 2 metres or behind it: the far
// side of their edges is on either side. `gap`: pixels without depth on the farther surface, to the
// right of the nearer one. `offset`: of all rectangles to the lower right, pixels.
BoxImage MakeRectangles(const cv::Size& size, int offset, int gap, double noise) {
  BoxImage image{cv::Mat(size, CV_8UC1, cv::Scalar(120)), cv::Mat(size, CV_32FC1, cv::Scalar(2))};
  for (const Rectangle& r :
       {Rectangle{0.10, 0.12, 0.26, 0.45, 1.2f, 40}, Rectangle{0.36, 0.15, 0.57, 0.40, 4.0f, 200},
        Rectangle{0.68, 0.10, 0.88, 0.48, 1.5f, 190}, Rectangle{0.15, 0.60, 0.41, 0.85, 3.5f, 30},
        Rectangle{0.53, 0.58, 0.83, 0.88, 1.0f, 210}}) {
    const cv::Rect area =
        cv::Rect(cv::Point(cvRound(r.left * size.width), cvRound(r.top * size.height)),
                 cv::Point(cvRound(r.right * size.width), cvRound(r.bottom * size.height))) +
        cv::Point(offset, offset);
    image.gray(area).setTo(r.gray);
    image.depth(area).setTo(r.depth);
    const int shadow = r.depth < 2.0f ? area.x + area.width : area.x;
    if (gap > 0) image.depth(cv::Rect(shadow, area.y, gap, area.height)).setTo(0.0f);
  }
  cv::RNG random(1);
  for (auto gray = image.gray.begin<uint8_t>(); gray != image.gray.end<uint8_t>(); ++gray) {
    *gray = cv::saturate_cast<uint8_t>(*gray + random.gaussian(noise));
  }
  return image;
}

Eigen::Vector2d FoundShift(const BoxImage& image) {
  return FindPeak(AlignEdges(image.gray, image.depth)).shift;
}

class EdgeAlignmentTest : public testing::TestWithParam<cv::Size> {};

TEST_P(EdgeAlignmentTest, FindsNoShiftOfRegisteredDepth) {
  const Eigen::Vector2d found = FoundShift(MakeBoxes(GetParam(), {0.0, 0.0}));
  EXPECT_LT(found.norm(), 0.3) << found.transpose();
}

// The shift that is found for rectangles on the average over their places: depth is sampled when
// images are reduced, so that an edge is found up to half a step beside its place.
Eigen::Vector2d MeanShiftOfRectangles(const cv::Size& size, int gap, double noise) {
  constexpr int kNumOffsets = 4;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < kNumOffsets; ++i) sum += FoundShift(MakeRectangles(size, i, gap, noise));
  return sum / kNumOffsets;
}

// Pixels. Of images that are reduced to 640 pixels in width, a fifth of a step.
double Tolerance(int width) { return width > 640 ? 0.2 * width / 640.0 : 0.1; }

TEST_P(EdgeAlignmentTest, FindsNoShiftOfRectanglesInFrontOfAndBehindAWall) {
  const double tolerance = Tolerance(GetParam().width);
  for (const double noise : {0.0, 0.5, kNoise}) {
    const Eigen::Vector2d found = MeanShiftOfRectangles(GetParam(), 0, noise);
    EXPECT_LT(found.norm(), tolerance) << found.transpose() << " with noise " << noise;
  }
}

TEST_P(EdgeAlignmentTest, FindsNoShiftBesideTheShadowOfTheSensor) {
  const int width = GetParam().width;
  for (const int gap : {2, 8, 12, 16, 18}) {
    const Eigen::Vector2d found =
        MeanShiftOfRectangles(GetParam(), gap * std::max(320, width) / 640, 2.0);
    EXPECT_LT(found.norm(), Tolerance(width)) << found.transpose() << " with a gap of " << gap;
  }
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

// Sum of `count` images, each shifted by `step` pixels against the one before.
EdgeAlignment SumOfImages(int count, int step) {
  const BoxImage image = MakeRectangles({640, 480}, 0, 0, 0.0);
  EdgeAlignment sum;
  for (int i = 0; i < count; ++i) {
    const cv::Rect view(i * step, i * step, 480, 360);
    Add(AlignEdges(image.gray(view), image.depth(view)), &sum);
  }
  return sum;
}

TEST(NumDistinctEdgesTest, CountsRepeatedEdgesOnce) {
  const EdgeAlignment one = SumOfImages(1, 0), still = SumOfImages(10, 0);
  EXPECT_EQ(NumDistinctEdges(one), one.coarse.num_edges);
  EXPECT_EQ(still.coarse.num_edges, 10 * one.coarse.num_edges);
  EXPECT_EQ(NumDistinctEdges(still), one.coarse.num_edges);
}

TEST(NumDistinctEdgesTest, CountsEdgesAtOtherPlaces) {
  const EdgeAlignment moving = SumOfImages(10, 12);
  EXPECT_GT(NumDistinctEdges(moving), 6 * NumDistinctEdges(SumOfImages(1, 0)));
}

TEST(FindPeakTest, StaysAtTheCoarsePeakWithoutFineEdges) {
  EdgeAlignment alignment = SumOfImages(1, 0);
  const Eigen::Vector2d expected = FindPeak(alignment).shift;
  alignment.fine.num_edges = 0;
  for (cv::Mat& side : alignment.fine.by_side) side.setTo(0.0);
  EXPECT_LT((FindPeak(alignment).shift - expected).norm(), 0.3);
}

// Rectangles of which the depth image shows the near sides wider by `radius` pixels, as stereo
// matchers do, and shifted by (dx, dy).
EdgeAlignment WidenedRectangles(int radius, int dx, int dy) {
  BoxImage image = MakeRectangles({640, 480}, 0, 0, 2.0);
  const cv::Mat window = cv::Mat::ones(2 * radius + 1, 2 * radius + 1, CV_8UC1);
  cv::erode(image.depth, image.depth, window, {-1, -1}, 1, cv::BORDER_REPLICATE);
  const cv::Mat translation = (cv::Mat_<double>(2, 3) << 1.0, 0.0, dx, 0.0, 1.0, dy);
  cv::Mat shifted;
  cv::warpAffine(image.depth, shifted, translation, image.depth.size(), cv::INTER_NEAREST,
                 cv::BORDER_REPLICATE);
  return AlignEdges(image.gray, shifted);
}

TEST(FindPeakTest, DistinguishesWiderNearSurfacesFromAShift) {
  for (const int radius : {4, 6}) {
    const EdgeShift registered = FindPeak(WidenedRectangles(radius, 0, 0));
    EXPECT_LT(registered.shift.norm(), 1.0) << registered.shift.transpose();
    EXPECT_NEAR(registered.widening, radius, 1.0);
    const EdgeShift shifted = FindPeak(WidenedRectangles(radius, 9, -6));
    EXPECT_LT((shifted.shift - Eigen::Vector2d(-9.0, 6.0)).norm(), 1.0)
        << shifted.shift.transpose();
  }
}

Severity SeverityOfShift(const EdgeAlignment& image) {
  Findings findings;
  AddRegistrationFindings({image, image, image, image}, 640, &findings);
  return findings.at(0).severity;
}

TEST(RegistrationFindingsTest, WarnOfAShiftButNotOfWiderNearSurfaces) {
  EXPECT_EQ(SeverityOfShift(WidenedRectangles(5, 0, 0)), Severity::kGood);
  for (const int radius : {0, 5}) {
    EXPECT_EQ(SeverityOfShift(WidenedRectangles(radius, 9, -6)), Severity::kWarning) << radius;
  }
}

// The motion of the camera during the delay shifts the edges.
TEST(RegistrationFindingsTest, LeaveOutImagesWithALongDelayOfDepth) {
  EdgeAlignment image = WidenedRectangles(0, 9, -6);
  image.depth_delay = 0.04;
  EXPECT_EQ(SeverityOfShift(image), Severity::kGood);
  image.depth_delay = -0.01;
  EXPECT_EQ(SeverityOfShift(image), Severity::kWarning);
}

INSTANTIATE_TEST_SUITE_P(Sizes, EdgeAlignmentTest,
                         testing::Values(cv::Size(320, 240), cv::Size(512, 424), cv::Size(640, 480),
                                         cv::Size(848, 480), cv::Size(1280, 720)));

}  // namespace
}  // namespace msc_vo
