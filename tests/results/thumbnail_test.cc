// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/thumbnail.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

namespace msc_vo {
namespace {

cv::Mat Decode(const std::string& jpeg) {
  return cv::imdecode(std::vector<char>(jpeg.begin(), jpeg.end()), cv::IMREAD_UNCHANGED);
}

// An image without smooth parts.
RgbdImage Noise(const cv::Size& size) {
  RgbdImage image;
  image.gray = cv::Mat(size, CV_8UC1);
  cv::RNG(7).fill(image.gray, cv::RNG::UNIFORM, 0, 256);
  return image;
}

TEST(EncodeThumbnail, ReducesTheImage) {
  const std::string jpeg = EncodeThumbnail(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90)));
  const cv::Mat image = Decode(jpeg);
  EXPECT_EQ(image.size(), cv::Size(320, 240));
  EXPECT_EQ(image.type(), CV_8UC1);
  EXPECT_NEAR(image.at<uchar>(100, 100), 90, 2);
}

TEST(EncodeThumbnail, HandlesSmallAndOddImages) {
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(641, 479), cv::Size(1200, 680)}) {
    const std::string jpeg = EncodeThumbnail(cv::Mat(size, CV_8UC1, cv::Scalar(90)));
    const cv::Mat image = Decode(jpeg);
    EXPECT_LE(image.cols, 320);
    EXPECT_NEAR(image.cols * size.height, image.rows * size.width, 3 * size.width);
  }
}

TEST(EncodeThumbnail, ShowsTheWholeImage) {
  constexpr int kWidth = 848;  // not a multiple of the factor, three
  cv::Mat gray = cv::Mat::zeros(480, kWidth, CV_8UC1);
  gray.colRange(kWidth - 2, kWidth) = 255;
  const cv::Mat image = Decode(EncodeThumbnail(gray));
  EXPECT_GT(cv::mean(image.col(image.cols - 1))[0], 100.0);
}

TEST(EncodeMapImage, IsSmallWhateverTheImageShows) {
  for (const cv::Size size : {cv::Size(160, 120), cv::Size(640, 480), cv::Size(480, 640),
                              cv::Size(1280, 720), cv::Size(90, 4000)}) {
    RgbdImage uniform;
    uniform.gray = cv::Mat(size, CV_8UC1, cv::Scalar(90));
    for (const RgbdImage& image : {Noise(size), uniform}) {
      const std::string jpeg = EncodeMapImage(image);
      EXPECT_LE(jpeg.size(), 2000u) << size;
      const cv::Mat decoded = Decode(jpeg);
      EXPECT_EQ(decoded.type(), CV_8UC1);
      EXPECT_LE(std::max(decoded.cols, decoded.rows), 160) << size;
      EXPECT_GE(std::max(decoded.cols, decoded.rows), 80) << size;
    }
  }
}

TEST(EncodeMapImage, KeepsWhatASmoothImageShows) {
  RgbdImage image;
  image.gray = cv::Mat(480, 640, CV_8UC1);
  for (int x = 0; x < 640; ++x) image.gray.col(x).setTo(40 + x / 4);
  const cv::Mat decoded = Decode(EncodeMapImage(image));
  ASSERT_EQ(decoded.size(), cv::Size(160, 120));
  for (int x = 0; x < 160; x += 10) EXPECT_NEAR(decoded.at<uchar>(60, x), 40 + x, 4) << x;
}

TEST(EncodeMapImage, HidesWhatTheMaskLeavesOut) {
  RgbdImage image = Noise({640, 480});
  const cv::Mat whole = image.gray.clone();
  image.mask = cv::Mat::zeros(480, 640, CV_8UC1);
  image.mask.colRange(320, 640).setTo(7);
  const cv::Mat decoded = Decode(EncodeMapImage(image));
  double darkest = 0.0, brightest = 0.0;
  cv::minMaxLoc(decoded.colRange(88, 160), &darkest, &brightest);
  EXPECT_LT(brightest, 16.0);
  cv::minMaxLoc(decoded.colRange(0, 72), &darkest, &brightest);
  EXPECT_GT(brightest, 100.0);
  EXPECT_EQ(cv::norm(image.gray, whole, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace msc_vo
