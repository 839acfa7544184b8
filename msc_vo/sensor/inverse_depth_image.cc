// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

void InverseDepthImage::Assign(const cv::Mat& depth, double min_depth, double max_depth) {
  image_.create(depth.size(), CV_32FC1);
  const float nearest = static_cast<float>(min_depth);
  const float farthest = static_cast<float>(max_depth);
  for (int y = 0; y < depth.rows; ++y) {
    const float* z = depth.ptr<float>(y);
    float* inverse = image_.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) {
      // False for NaN. Unconditional division lets the compiler process several pixels at once.
      const bool valid = (z[x] >= nearest) & (z[x] <= farthest);
      const float quotient = 1.0f / (valid ? z[x] : 1.0f);
      inverse[x] = valid ? quotient : 0.0f;
    }
  }
}

}  // namespace msc_vo
