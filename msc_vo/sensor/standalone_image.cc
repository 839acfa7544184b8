// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

cv::Mat StandaloneImage(const cv::Mat& image) {
  return image.isContinuous() && !image.isSubmatrix() ? image : image.clone();
}

RgbdImage StandaloneImages(RgbdImage image) {
  image.gray = StandaloneImage(image.gray);
  image.depth = StandaloneImage(image.depth);
  image.recorded_depth = StandaloneImage(image.recorded_depth);
  image.mask = StandaloneImage(image.mask);
  return image;
}

}  // namespace msc_vo
