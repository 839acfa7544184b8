// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/point_extractor.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

bool Same(const PointFeature& a, const PointFeature& b) {
  return a.pixel == b.pixel && a.sigma == b.sigma && a.level == b.level && a.angle == b.angle &&
         a.descriptor == b.descriptor;
}

struct Match {
  int a = 0;
  int b = 0;
};

// Matches each point of `a` by descriptor with the points of the same level within 3 px (of the
// level) of its position after the motion `moved`.
template <typename Function>
std::vector<Match> MatchPoints(const std::vector<PointFeature>& a,
                               const std::vector<PointFeature>& b, const Function& moved) {
  std::vector<Match> matches;
  for (size_t i = 0; i < a.size(); ++i) {
    int best = 64;
    int index = -1;
    for (size_t j = 0; j < b.size(); ++j) {
      if (a[i].level != b[j].level) continue;
      if ((moved(a[i].pixel) - b[j].pixel).norm() > 3.0 * a[i].sigma) continue;
      const int distance = HammingDistance(a[i].descriptor, b[j].descriptor);
      if (distance >= best) continue;
      best = distance;
      index = static_cast<int>(j);
    }
    if (index >= 0) matches.push_back({static_cast<int>(i), index});
  }
  return matches;
}

double Median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

TEST(PointExtractor, DistributesPointsEvenly) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0, 2.0);
  PointExtractorOptions options;
  options.num_points = 1000;
  const auto points = PointExtractor(options).Extract(image);
  EXPECT_GT(points.size(), 800u);
  EXPECT_LE(points.size(), 1000u);
  std::set<int> levels;
  std::vector<int> per_block(8 * 6, 0);
  for (const PointFeature& point : points) {
    ASSERT_GE(point.pixel.x(), 0.0);
    ASSERT_LE(point.pixel.x(), 639.0);
    ASSERT_GE(point.pixel.y(), 0.0);
    ASSERT_LE(point.pixel.y(), 479.0);
    EXPECT_NEAR(point.sigma, std::pow(1.2, point.level), 1e-9);
    EXPECT_FALSE(point.HasDepth());
    levels.insert(point.level);
    ++per_block[static_cast<int>(point.pixel.y() / 80) * 8 +
                static_cast<int>(point.pixel.x() / 80)];
  }
  EXPECT_EQ(levels.size(), 8u);
  // 80x80 px hold 21 of 1000 points on average.
  EXPECT_LE(std::count_if(per_block.begin(), per_block.end(), [](int n) { return n < 5; }), 4);
  EXPECT_LE(*std::max_element(per_block.begin(), per_block.end()), 60);
}

TEST(PointExtractor, RespectsNumberOfPoints) {
  const cv::Mat image = testing::DrawQuadrilaterals(320, 240, {0.0, 0.0});
  for (const int wanted : {0, 1, 50, 300}) {
    PointExtractorOptions options;
    options.num_points = wanted;
    PointExtractor extractor(options);
    EXPECT_LE(static_cast<int>(extractor.Extract(image).size()), wanted);
  }
}

TEST(PointExtractor, LowersThresholdWhereContrastIsLow) {
  // Left half: squares of contrast 12, below the threshold of 20; right half: contrast 120.
  testing::Canvas canvas(320, 240, 100);
  for (int y = 30; y < 220; y += 40) {
    for (int x = 30; x < 300; x += 40) {
      canvas.FillRectangle(x, y, x + 16, y + 16, x < 160 ? 112 : 220);
    }
  }
  const cv::Mat image = canvas.Render();
  const auto left = [](const PointFeature& point) { return point.pixel.x() < 150.0; };
  PointExtractor with_fallback({});
  const auto points = with_fallback.Extract(image);
  EXPECT_GT(std::count_if(points.begin(), points.end(), left), 20);
  PointExtractorOptions options;
  options.min_fast_threshold = options.fast_threshold;
  PointExtractor without(options);
  const auto fewer = without.Extract(image);
  EXPECT_EQ(std::count_if(fewer.begin(), fewer.end(), left), 0);
  EXPECT_GT(fewer.size(), 20u);
}

TEST(PointExtractor, RepeatsCornersToSubPixels) {
  const Vector2d shift(3.375, -2.625);
  PointExtractor extractor({});
  const auto a = extractor.Extract(testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}));
  const auto b = extractor.Extract(testing::DrawQuadrilaterals(640, 480, shift));
  const auto matches = MatchPoints(a, b, [&](const Vector2d& x) { return Vector2d(x + shift); });
  EXPECT_GT(matches.size(), a.size() * 7 / 10);
  std::vector<double> errors;
  Vector2d mean = Vector2d::Zero();
  for (const Match& match : matches) {
    const Vector2d error = b[match.b].pixel - a[match.a].pixel - shift;
    errors.push_back(error.norm() / a[match.a].sigma);
    if (error.norm() < a[match.a].sigma) mean += error / matches.size();
  }
  EXPECT_LT(Median(errors), 0.16);  // corners at whole pixels: 0.4; measured 0.153
  EXPECT_LT(mean.norm(), 0.05);     // no bias on any level
}

TEST(PointExtractor, OrientationFollowsRotationOfImage) {
  const double angle = DegreesToRadians(25.0);
  PointExtractor extractor({});
  const auto a = extractor.Extract(testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0));
  const auto b = extractor.Extract(testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, angle));
  const Vector2d middle(319.5, 239.5);
  Eigen::Matrix2d turn;
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const auto matches =
      MatchPoints(a, b, [&](const Vector2d& x) { return Vector2d(middle + turn * (x - middle)); });
  // Points near a border have left the image.
  EXPECT_GT(matches.size(), a.size() / 3);
  std::vector<double> errors;
  for (const Match& match : matches) {
    errors.push_back(
        std::abs(std::remainder(b[match.b].angle - a[match.a].angle - angle, 2 * kPi)));
  }
  EXPECT_LT(Median(errors), DegreesToRadians(3.0));
}

TEST(PointExtractor, IsDeterministicAtAnyThreadCount) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0, 3.0);
  const int threads = cv::getNumThreads();
  PointExtractor extractor({});
  cv::setNumThreads(1);
  const auto a = extractor.Extract(image);
  const auto b = extractor.Extract(image);
  cv::setNumThreads(2);
  const auto c = PointExtractor({}).Extract(image);
  cv::setNumThreads(threads);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), c.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(Same(a[i], b[i])) << i;
    EXPECT_TRUE(Same(a[i], c[i])) << i;
  }
}

TEST(PointExtractor, ExtractsNothingFromUniformImages) {
  PointExtractor extractor({});
  EXPECT_TRUE(extractor.Extract(cv::Mat::zeros(480, 640, CV_8UC1)).empty());
  EXPECT_TRUE(extractor.Extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(255))).empty());
  EXPECT_TRUE(extractor.Extract(cv::Mat(20, 20, CV_8UC1, cv::Scalar(9))).empty());
  // A small image has fewer levels.
  EXPECT_GT(extractor.Extract(testing::DrawQuadrilaterals(160, 120, {0.0, 0.0})).size(), 20u);
}

TEST(PointExtractor, ThrowsOnInvalidImage) {
  PointExtractor extractor({});
  EXPECT_THROW(extractor.Extract(cv::Mat::zeros(10, 10, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(extractor.Extract(cv::Mat()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
