// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/registration_target.h"

namespace msc_vo {

namespace {

// Whether a surface on both sides is in front of a pixel.
bool IsBehind(float side, float other, float inverse_depth) {
  const float near = std::max(side, other);
  const float far = std::min(side, other);
  return (near - far <= EdgeThreshold(near)) & (far > inverse_depth + EdgeThreshold(inverse_depth));
}

}  // namespace

cv::Mat RegistrationTarget::Depth() const {
  cv::Mat depth(height(), width(), CV_32FC1);
  std::vector<float> sides[4];
  for (std::vector<float>& side : sides) side.resize(width());
  for (int y = 0; y < height(); ++y) {
    FindNearest(y, 0, -1, &sides[0]);
    FindNearest(y, 0, 1, &sides[1]);
    FindNearest(y, -1, 0, &sides[2]);
    FindNearest(y, 1, 0, &sides[3]);
    WriteRow(sides, inverse_depth_.ptr<float>(y + radius_) + radius_, depth.ptr<float>(y));
  }
  return depth;
}

// Largest inverse depth on one side of every pixel of a row, within the radius.
void RegistrationTarget::FindNearest(int y, int step_y, int step_x,
                                     std::vector<float>* nearest) const {
  const int size = width();
  float* const to = nearest->data();
  std::fill(nearest->begin(), nearest->end(), 0.0f);
  for (int k = 1; k <= radius_; ++k) {
    const float* const from =
        inverse_depth_.ptr<float>(y + radius_ + k * step_y) + radius_ + k * step_x;
#pragma GCC ivdep
    for (int x = 0; x < size; ++x) to[x] = std::max(to[x], from[x]);
  }
}

void RegistrationTarget::WriteRow(const std::vector<float> (&sides)[4], const float* inverse_depth,
                                  float* depth) const {
  const int size = width();
  const float *left = sides[0].data(), *right = sides[1].data();
  const float *above = sides[2].data(), *below = sides[3].data();
#pragma GCC ivdep
  for (int x = 0; x < size; ++x) {
    const float w = inverse_depth[x];
    const bool is_visible =
        (w > 0.0f) & !(IsBehind(left[x], right[x], w) | IsBehind(above[x], below[x], w));
    depth[x] = is_visible ? 1.0f / (is_visible ? w : 1.0f) : 0.0f;
  }
}

}  // namespace msc_vo
