// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_extractor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/features/drawing.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using Eigen::Vector2d;

LineExtractorOptions With(LineDetector detector) {
  LineExtractorOptions options;
  options.detector = detector;
  return options;
}

// True if both end points of the segments agree, in this order.
bool Near(const LineSegment2& a, const LineSegment2& b, double pixels) {
  return (a.start - b.start).norm() < pixels && (a.end - b.end).norm() < pixels;
}

class LineExtractorTest : public ::testing::TestWithParam<LineDetector> {};

TEST_P(LineExtractorTest, DetectsSidesOfQuadrilateral) {
  // Bright, with corners in clockwise order: the brighter side is on the right of every edge.
  const std::vector<Vector2d> corners = {
      {100.3, 80.0}, {260.0, 110.6}, {230.4, 250.0}, {70.0, 200.2}};
  testing::Canvas canvas(400, 300, 60);
  canvas.FillPolygon(corners, 200);
  LineExtractor extractor(With(GetParam()));
  const auto lines = extractor.Extract(canvas.Render(1.0));
  ASSERT_EQ(lines.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    const LineSegment2 side{corners[i], corners[(i + 1) % 4]};
    const auto found = std::find_if(lines.begin(), lines.end(), [&](const LineFeature& line) {
      // End points along the side stop short of the corner's blur.
      return Near(line.segment, side, 4.0);
    });
    ASSERT_NE(found, lines.end()) << "side " << i;
    EXPECT_LT(side.DistanceToLine(found->segment.start), 0.5);
    EXPECT_LT(side.DistanceToLine(found->segment.end), 0.5);
    const Eigen::Vector3d image_line = ImageLine(found->segment);
    EXPECT_GT(image_line.dot(Eigen::Vector3d(165.0, 160.0, 1.0)), 0.0);
    EXPECT_FALSE(found->depth);
  }
}

TEST_P(LineExtractorTest, OrientsSegmentsToBrighterSide) {
  testing::Canvas canvas(400, 300, 200);
  canvas.FillRectangle(100, 100, 300, 200, 60);
  LineExtractor extractor(With(GetParam()));
  const auto lines = extractor.Extract(canvas.Render(1.0));
  ASSERT_EQ(lines.size(), 4u);
  for (const LineFeature& line : lines) {
    EXPECT_LT(ImageLine(line.segment).dot(Eigen::Vector3d(200.0, 150.0, 1.0)), 0.0);
  }
}

TEST_P(LineExtractorTest, MergesEdgeInterruptedByBar) {
  testing::Canvas canvas(400, 300, 60);
  canvas.FillRectangle(-10, 150, 410, 310, 180);
  canvas.FillRectangle(197, -10, 203, 310, 110);
  LineExtractor extractor(With(GetParam()));
  const auto lines = extractor.Extract(canvas.Render(1.0));
  const auto horizontal = std::count_if(lines.begin(), lines.end(), [](const LineFeature& line) {
    return std::abs(line.segment.Direction().y()) < 0.1 && line.segment.Length() > 350.0;
  });
  EXPECT_EQ(horizontal, 1);
}

TEST_P(LineExtractorTest, DropsShortLines) {
  testing::Canvas canvas(400, 300, 60);
  for (int i = 0; i < 6; ++i) canvas.FillRectangle(30 + 60 * i, 40, 42 + 60 * i, 52, 200);
  canvas.FillRectangle(100, 150, 300, 250, 200);
  const cv::Mat image = canvas.Render(1.0);
  EXPECT_EQ(LineExtractor(With(GetParam())).Extract(image).size(), 4u);  // 15 px and longer
  LineExtractorOptions options = With(GetParam());
  options.min_length = 0.4;  // 120 px and longer
  EXPECT_EQ(LineExtractor(options).Extract(image).size(), 2u);
}

TEST_P(LineExtractorTest, KeepsLongestLines) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0});
  const auto all = LineExtractor(With(GetParam())).Extract(image);
  ASSERT_GT(all.size(), 60u);
  LineExtractorOptions options = With(GetParam());
  options.max_lines = 40;
  const auto few = LineExtractor(options).Extract(image);
  ASSERT_EQ(few.size(), 40u);
  for (size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].segment.start, all[i].segment.start);
    // Refinement after the selection may change lengths slightly.
    if (i > 0) {
      EXPECT_LE(few[i].segment.Length(), few[i - 1].segment.Length() + 0.1);
    }
    EXPECT_EQ(few[i].descriptor, all[i].descriptor);
  }
  options.max_lines = 0;
  EXPECT_TRUE(LineExtractor(options).Extract(image).empty());
}

TEST_P(LineExtractorTest, MatchesDescriptorsOfShiftedImage) {
  const Vector2d shift(5.25, 3.5);
  LineExtractor extractor(With(GetParam()));
  const auto a = extractor.Extract(testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}));
  const auto b = extractor.Extract(testing::DrawQuadrilaterals(640, 480, shift));
  int present = 0;
  int correct = 0;
  for (const LineFeature& line : a) {
    const LineSegment2 moved{line.segment.start + shift, line.segment.end + shift};
    const auto same = [&](const LineFeature& other) { return Near(moved, other.segment, 3.0); };
    if (std::none_of(b.begin(), b.end(), same)) continue;
    ++present;
    const auto nearest =
        std::min_element(b.begin(), b.end(), [&](const LineFeature& p, const LineFeature& q) {
          return HammingDistance(line.descriptor, p.descriptor) <
                 HammingDistance(line.descriptor, q.descriptor);
        });
    correct += same(*nearest);
  }
  EXPECT_GT(present, static_cast<int>(a.size()) * 6 / 10);
  EXPECT_GT(correct, present * 9 / 10);
}

TEST_P(LineExtractorTest, ClipsLinesToMask) {
  testing::Canvas canvas(400, 300, 60);
  canvas.FillRectangle(-10, 150, 410, 310, 180);
  cv::Mat mask = cv::Mat::zeros(300, 400, CV_8UC1);
  mask.colRange(100, 301).setTo(255);
  const auto lines = LineExtractor(With(GetParam())).Extract(canvas.Render(1.0), mask);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].segment.start.x(), 100.0, 1.5);
  EXPECT_NEAR(lines[0].segment.end.x(), 300.0, 1.5);
  EXPECT_TRUE(LineExtractor(With(GetParam()))
                  .Extract(canvas.Render(1.0), cv::Mat::zeros(300, 400, CV_8UC1))
                  .empty());
}

TEST_P(LineExtractorTest, IsDeterministicAtAnyThreadCount) {
  const cv::Mat image = testing::DrawQuadrilaterals(640, 480, {0.0, 0.0}, 0.0, 3.0);
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  LineExtractor extractor(With(GetParam()));
  const auto a = extractor.Extract(image);
  extractor.Extract(testing::DrawQuadrilaterals(640, 480, {9.0, 9.0}));  // must leave no state
  const auto b = extractor.Extract(image);
  cv::setNumThreads(2);
  const auto c = LineExtractor(With(GetParam())).Extract(image);
  cv::setNumThreads(threads);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.size(), c.size());
  for (size_t i = 0; i < a.size(); ++i) {
    for (const LineFeature* other : {&b[i], &c[i]}) {
      EXPECT_EQ(a[i].segment.start, other->segment.start);
      EXPECT_EQ(a[i].segment.end, other->segment.end);
      EXPECT_EQ(a[i].descriptor, other->descriptor);
    }
  }
}

TEST_P(LineExtractorTest, DetectsNothingInUniformImages) {
  LineExtractor extractor(With(GetParam()));
  EXPECT_TRUE(extractor.Extract(cv::Mat::zeros(480, 640, CV_8UC1)).empty());
  EXPECT_TRUE(extractor.Extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(128))).empty());
  EXPECT_TRUE(extractor.Extract(cv::Mat(16, 16, CV_8UC1, cv::Scalar(7))).empty());
  EXPECT_GT(extractor.Extract(testing::DrawQuadrilaterals(160, 120, {0.0, 0.0})).size(), 5u);
}

TEST_P(LineExtractorTest, DescribesLinesAtBorder) {
  testing::Canvas canvas(200, 150, 60);
  canvas.FillRectangle(1.5, 1.5, 197.5, 147.5, 180);
  const auto lines = LineExtractor(With(GetParam())).Extract(canvas.Render());
  for (const LineFeature& line : lines) {
    EXPECT_TRUE(line.segment.start.allFinite() && line.segment.end.allFinite());
    EXPECT_NE(line.descriptor, Descriptor{});
  }
}

INSTANTIATE_TEST_SUITE_P(Detectors, LineExtractorTest,
                         ::testing::Values(LineDetector::kLsd, LineDetector::kEdgeDrawing),
                         [](const auto& detector) {
                           return detector.param == LineDetector::kLsd ? "Lsd" : "EdgeDrawing";
                         });

TEST(LineExtractor, ThrowsOnInvalidImage) {
  LineExtractor extractor({});
  EXPECT_THROW(extractor.Extract(cv::Mat::zeros(10, 10, CV_32FC1)), std::invalid_argument);
  EXPECT_THROW(extractor.Extract(cv::Mat()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
