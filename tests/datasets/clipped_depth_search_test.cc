// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/clipped_depth_search.h"

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/message_matchers.h"
#include "tests/support/rendered_depth.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/image_container.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Depth images in memory. Those without pixels cannot be read.
class DepthImages : public ImageContainer {
 public:
  explicit DepthImages(std::vector<cv::Mat> images) : images_(std::move(images)) {}

  StoredImage ReadColor(int /*index*/) const override { return {}; }
  StoredImage ReadDepth(int index) const override {
    if (images_.at(index).empty()) throw std::runtime_error("damaged");
    return {"", images_[index]};
  }

 private:
  std::vector<cv::Mat> images_;
};

SequenceIndex Sequence(const std::vector<cv::Mat>& images) {
  SequenceIndex index;
  for (size_t i = 0; i < images.size(); ++i) {
    SequenceEntry& entry = index.entries.emplace_back();
    entry.timestamp = static_cast<double>(i);
    entry.depth_index = static_cast<int>(i);
  }
  index.container = std::make_shared<DepthImages>(images);
  return index;
}

class ClippedDepthSearchTest : public testing::Test {
 protected:
  // Images that are clipped to [nearest, farthest], metres.
  static std::vector<cv::Mat> Clipped(double nearest, double farthest) {
    std::vector<cv::Mat> images;
    for (const cv::Mat& image : Images()) {
      images.push_back(cv::max(cv::min(image, farthest), nearest));
      images.back().setTo(0.0f, image <= 0.0f);
    }
    return images;
  }
  static std::vector<cv::Mat> Raw(double units, std::vector<cv::Mat> images) {
    for (cv::Mat& image : images) image = RoundedTo(units, image);
    return images;
  }
  static const std::vector<cv::Mat>& Images() {
    static const std::vector<cv::Mat> images =
        RenderDepth(SceneKind::kRoom, SyntheticDepth::kStructuredLight, 40);
    return images;
  }
};

TEST_F(ClippedDepthSearchTest, FindsBothEnds) {
  const ClippedDepth clipped = FindClippedDepth(Sequence(Raw(5000.0, Clipped(1.8, 2.6))));
  EXPECT_EQ(clipped.limits.nearest, 9000.0f);
  EXPECT_EQ(clipped.limits.farthest, 13000.0f);
  EXPECT_GT(clipped.nearest_ratio, 0.01);
  EXPECT_LT(clipped.nearest_ratio, 0.5);
  EXPECT_GT(clipped.farthest_ratio, 0.1);
  const std::vector<ClippingReport> reports = DescribeClippedDepth(clipped, 5000.0);
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_NEAR(reports[0].depth, 1.8, 1e-9);
  EXPECT_THAT(reports[0].text, Names("1.800 m", "raw", "9000", "nearer"));
  EXPECT_THAT(reports[1].text, Names("2.600 m", "raw", "13000", "farther"));
}

TEST_F(ClippedDepthSearchTest, FindsTheEndBelowAMark) {
  std::vector<cv::Mat> images = Raw(1000.0, Clipped(0.0, 2.6));
  for (cv::Mat& image : images) image.rowRange(0, 40).setTo(65535);
  EXPECT_EQ(FindClippedDepth(Sequence(images)).limits.farthest, 2600.0f);
}

TEST_F(ClippedDepthSearchTest, ReadsMetres) {
  const ClippedDepth clipped = FindClippedDepth(Sequence(Clipped(0.0, 2.6)));
  EXPECT_EQ(clipped.limits.farthest, 2.6f);
  const std::vector<ClippingReport> reports = DescribeClippedDepth(clipped, 5000.0);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_THAT(reports[0].text, AllOf(HasSubstr("2.600 m"), Not(HasSubstr("raw"))));
}

TEST_F(ClippedDepthSearchTest, FindsNothingInWholeDepthNorWithoutImages) {
  for (const double units : {100.0, 1000.0, 5000.0}) {
    const ClippedDepth whole = FindClippedDepth(Sequence(Raw(units, Clipped(0.0, 100.0))));
    EXPECT_TRUE(DescribeClippedDepth(whole, units).empty()) << units;
  }
  EXPECT_TRUE(DescribeClippedDepth(FindClippedDepth(SequenceIndex()), 1000.0).empty());
}

TEST_F(ClippedDepthSearchTest, LeavesOutDamagedImages) {
  std::vector<cv::Mat> images = Raw(1000.0, Clipped(0.0, 2.6));
  for (size_t i = 0; i < images.size(); i += 3) images[i].release();
  EXPECT_EQ(FindClippedDepth(Sequence(images)).limits.farthest, 2600.0f);
  for (cv::Mat& image : images) image.release();
  EXPECT_FALSE(FindClippedDepth(Sequence(images)).limits.HasFarthest());
}

}  // namespace
}  // namespace msc_vo
