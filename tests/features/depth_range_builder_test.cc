// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_range_builder.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

constexpr int kWidth = 320, kHeight = 240;  // cells of 10 x 10 pixels

PinholeCamera RangeCamera() { return {260.0, 260.0, 159.5, 119.5, kWidth, kHeight}; }

DepthRanges RangesOf(const cv::Mat& depth, const LensDistortion& lens = LensDistortion()) {
  return MakeDepthRanges(InverseDepthImage(depth, 0.2, 10.0), LensRemap(RangeCamera(), lens),
                         RangeCamera());
}

TEST(MakeDepthRanges, ContainsTheDepthsOfACell) {
  cv::Mat depth(kHeight, kWidth, CV_32FC1, cv::Scalar(4.0));
  depth(cv::Rect(104, 0, 216, kHeight)) = 2.0;  // an edge inside of column 10
  const DepthRanges ranges = RangesOf(depth);
  ASSERT_EQ(ranges.cells.size(), size_t{DepthRanges::kColumns * DepthRanges::kRows});
  EXPECT_FLOAT_EQ(ranges.At(5, 12).max_inverse_depth, 0.25f);
  EXPECT_FLOAT_EQ(ranges.At(5, 12).min_inverse_depth, 0.25f);
  EXPECT_FLOAT_EQ(ranges.At(10, 12).max_inverse_depth, 0.5f);
  EXPECT_FLOAT_EQ(ranges.At(10, 12).min_inverse_depth, 0.25f);
  EXPECT_FLOAT_EQ(ranges.At(20, 12).min_inverse_depth, 0.5f);
}

TEST(MakeDepthRanges, IsEmptyWhereLessThanHalfOfACellHasADepth) {
  cv::Mat depth(kHeight, kWidth, CV_32FC1, cv::Scalar(2.0));
  depth(cv::Rect(0, 0, 108, kHeight)) = 0.0;
  const DepthRanges ranges = RangesOf(depth);
  EXPECT_FALSE(ranges.At(10, 3).HasDepth());
  EXPECT_TRUE(ranges.At(11, 3).HasDepth());
}

// A barrel lens: what the undistorted image shows near its border is nearer to the middle of the
// raw one.
TEST(MakeDepthRanges, AreThoseOfTheUndistortedImage) {
  cv::Mat depth(kHeight, kWidth, CV_32FC1, cv::Scalar(4.0));
  depth(cv::Rect(300, 0, 20, kHeight)) = 2.0;
  LensDistortion lens;
  lens.k = {-0.3, 0.1};
  EXPECT_FLOAT_EQ(RangesOf(depth).At(30, 12).min_inverse_depth, 0.5f);
  EXPECT_FLOAT_EQ(RangesOf(depth, lens).At(30, 12).max_inverse_depth, 0.25f);
}

}  // namespace
}  // namespace msc_vo
