// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/motion_blur.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

constexpr int kMaxSamples = 32;
// Distance of the pixels whose displacement is computed.
constexpr int kGridStep = 8;

}  // namespace

double LargestImageMotion(const PinholeCamera& camera, const std::vector<float>& depth,
                          const Rigid3& b_from_a) {
  double largest = 0.0;
  for (int y = 0; y < camera.height; y += kGridStep) {
    for (int x = 0; x < camera.width; x += kGridStep) {
      const float z = depth[static_cast<size_t>(y) * camera.width + x];
      if (!(z > 0.0f)) continue;
      const Eigen::Vector2d pixel(x, y);
      const Eigen::Vector3d in_b = b_from_a * camera.BackProject(pixel, z);
      if (in_b.z() > 0.0) largest = std::max(largest, (camera.Project(in_b) - pixel).norm());
    }
  }
  return largest;
}

int NumExposureSamples(double motion) {
  return static_cast<int>(std::clamp(std::ceil(motion), 1.0, static_cast<double>(kMaxSamples)));
}

void ImageMean::Add(const std::vector<uint8_t>& values) {
  sums_.resize(values.size(), 0);
  for (size_t i = 0; i < values.size(); ++i) sums_[i] += values[i];
  ++count_;
}

std::vector<uint8_t> ImageMean::Value() const {
  std::vector<uint8_t> mean(sums_.size());
  for (size_t i = 0; i < mean.size(); ++i) {
    mean[i] = static_cast<uint8_t>((sums_[i] + count_ / 2) / count_);
  }
  return mean;
}

}  // namespace msc_vo
