// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/image_exposure.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace msc_vo {
namespace {

// Stripes an eighth of the width wide, whose edges are blurred by a Gaussian of `sigma` pixels.
cv::Mat BlurredStripes(int width, double sigma) {
  cv::Mat image(width * 3 / 4, width, CV_8UC1);
  for (int x = 0; x < width; ++x) image.col(x).setTo(x * 8 / width % 2 == 0 ? 90 : 150);
  cv::GaussianBlur(image, image, cv::Size(), sigma);
  return image;
}

TEST(ImageExposure, MeasuresTheSameBlurAtEveryImageSize) {
  for (const int width : {320, 640, 1280, 1920}) {
    const double sigma = 4.0 * width / 640.0;
    // Grey levels are rounded, so that the ends of a wide edge are flat.
    EXPECT_NEAR(MeasureExposure(BlurredStripes(width, sigma)).edge_width / (2.5 * sigma), 1.0, 0.1)
        << width;
  }
}

}  // namespace
}  // namespace msc_vo
