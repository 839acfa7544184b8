// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Runs whose images have masks.

#include <algorithm>
#include <random>

#include "tests/support/rendered_images.h"
#include <gtest/gtest.h>

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {
namespace {

class MaskedRunTest : public RoomTest {
 protected:
  // Half of the image.
  static cv::Rect Half() { return {0, 0, camera_.width / 2, camera_.height}; }
  static cv::Mat Mask() {
    cv::Mat mask = cv::Mat::zeros(camera_.height, camera_.width, CV_8UC1);
    mask(Half()) = 255;
    return mask;
  }
  // A texture at 0.9 m that passes in front of half of the camera.
  static RgbdImage CoverHalf(const RgbdImage& given) {
    RgbdImage image = given;
    image.gray = given.gray.clone();
    image.depth = given.depth.clone();
    constexpr int kTile = 9, kPixelsPerImage = 2;
    const int shift = kPixelsPerImage * static_cast<int>(given.id);
    for (int y = 0; y < Half().height; ++y) {
      for (int x = 0; x < Half().width; ++x) {
        std::minstd_rand random(
            1 + static_cast<unsigned>((x + shift) / kTile * 7919 + y / kTile * 104729));
        random.discard(2);
        image.gray.at<uint8_t>(y, x) = static_cast<uint8_t>(40 + random() % 160);
        image.depth.at<float>(y, x) = 0.9f;
      }
    }
    return image;
  }
  static OdometryResult Run(const std::vector<RgbdImage>& images) {
    OdometryOptions options;
    options.threads = 1;
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : images) odometry.Process(image);
    return odometry.Finish();
  }
};

TEST_F(MaskedRunTest, MovingTextureDoesNotCount) {
  std::vector<RgbdImage> covered, masked;
  for (const RgbdImage& image : *images_) {
    covered.push_back(CoverHalf(image));
    masked.push_back(covered.back());
    masked.back().mask = Mask();
  }
  const double without = ApeRmse(Run(covered));
  const double with = ApeRmse(Run(masked));
  RecordProperty("ape_without_mask_um", static_cast<int>(1e6 * without));
  RecordProperty("ape_with_mask_um", static_cast<int>(1e6 * with));
  EXPECT_LT(with, 0.02);
  EXPECT_GT(without, 3.0 * with);
}

TEST_F(MaskedRunTest, DepthBehindTheMaskHasNoEffect) {
  std::vector<RgbdImage> images(images_->begin(), images_->begin() + 30), changed;
  for (RgbdImage& image : images) {
    image.mask = Mask();
    changed.push_back(image);
    changed.back().depth = image.depth.clone();
    changed.back().depth(Half()) *= 0.6f;
  }
  ExpectSameBytes(Run(images), Run(changed));
}

}  // namespace
}  // namespace msc_vo
