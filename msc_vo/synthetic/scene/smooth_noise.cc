// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/smooth_noise.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

// Convolves the rows of a width x height field with a kernel, with periodic boundaries: the
// variance of the noise is the same up to the border.
std::vector<float> ConvolveRows(const std::vector<float>& field, int width, int height,
                                const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) / 2;
  std::vector<float> out(field.size(), 0.0f), ring(static_cast<size_t>(width + 2 * radius));
  for (int y = 0; y < height; ++y) {
    const float* row = field.data() + static_cast<size_t>(y) * width;
    float* sum = out.data() + static_cast<size_t>(y) * width;
    std::copy(row + width - radius, row + width, ring.begin());
    std::copy(row, row + width, ring.begin() + radius);
    std::copy(row, row + radius, ring.begin() + radius + width);
    for (size_t k = 0; k < kernel.size(); ++k) {
      for (int x = 0; x < width; ++x) sum[x] += kernel[k] * ring[x + k];
    }
  }
  return out;
}

// Convolves the columns of a field with a kernel, with periodic boundaries.
std::vector<float> ConvolveColumns(const std::vector<float>& field, int width, int height,
                                   const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size()) / 2;
  std::vector<float> out(field.size(), 0.0f);
  for (int y = 0; y < height; ++y) {
    float* sum = out.data() + static_cast<size_t>(y) * width;
    for (int k = -radius; k <= radius; ++k) {
      const float* row = field.data() + static_cast<size_t>((y + k + height) % height) * width;
      for (int x = 0; x < width; ++x) sum[x] += kernel[k + radius] * row[x];
    }
  }
  return out;
}

}  // namespace

std::vector<float> SmoothNoise(int width, int height, double sigma, Random* random) {
  std::vector<float> field(static_cast<size_t>(width) * height);
  for (float& value : field) value = static_cast<float>(random->Normal());
  // Three sigmas of the kernel, limited by the size of the image.
  const int radius =
      std::min(static_cast<int>(std::ceil(3.0 * sigma)), (std::min(width, height) - 1) / 2);
  std::vector<float> kernel;
  float squares = 0.0f;
  for (int k = -radius; k <= radius; ++k) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    squares += kernel.back() * kernel.back();
  }
  for (float& weight : kernel) weight /= std::sqrt(squares);  // preserves the variance
  return ConvolveColumns(ConvolveRows(field, width, height, kernel), width, height, kernel);
}

}  // namespace msc_vo
