// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/kinect_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "msc_vo/synthetic/scene/random.h"

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

// Normal noise of unit variance, correlated by a Gaussian of `sigma` pixels.
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

// Approximate tangent of the angle between ray and normal at (x, y): the change of depth per pixel
// (Sobel sums / 8) divided by the size of the pixel on a surface that faces the camera.
double Slope(const PinholeCamera& camera, const std::vector<float>& depth, int x, int y) {
  const auto at = [&](int i, int j) {
    i = std::clamp(i, 0, camera.width - 1);
    j = std::clamp(j, 0, camera.height - 1);
    return depth[static_cast<size_t>(j) * camera.width + i];
  };
  const double dx = at(x + 1, y - 1) + 2 * at(x + 1, y) + at(x + 1, y + 1) - at(x - 1, y - 1) -
                    2 * at(x - 1, y) - at(x - 1, y + 1);
  const double dy = at(x - 1, y + 1) + 2 * at(x, y + 1) + at(x + 1, y + 1) - at(x - 1, y - 1) -
                    2 * at(x, y - 1) - at(x + 1, y - 1);
  const double change = std::max(std::abs(dx), std::abs(dy)) / 8.0;
  return change / std::max<double>(at(x, y), 0.1) * camera.FocalLength();
}

// Depth at the pixel nearest to (x, y) + shift.
float ShiftedDepth(const PinholeCamera& camera, const std::vector<float>& depth, int x, int y,
                   const Eigen::Vector2d& shift) {
  const int i = std::clamp(static_cast<int>(std::lround(x + shift.x())), 0, camera.width - 1);
  const int j = std::clamp(static_cast<int>(std::lround(y + shift.y())), 0, camera.height - 1);
  return depth[static_cast<size_t>(j) * camera.width + i];
}

}  // namespace

bool KinectNoiseOptions::IsValid(std::string* error) const {
  if (!(focal_length > 0.0 && baseline > 0.0 && disparity_step > 0.0 && correlation > 0.0)) {
    *error = "kinect noise: focal_length, baseline, disparity_step, correlation must be positive";
  } else if (!(lateral_sigma >= 0.0 && disparity_sigma >= 0.0)) {
    *error = "kinect noise: lateral_sigma and disparity_sigma must not be negative";
  } else if (!(min_depth >= 0.0 && max_depth > min_depth)) {
    *error = "kinect noise: needs 0 <= min_depth < max_depth";
  } else if (!(lose_slope > keep_slope)) {
    *error = "kinect noise: lose_slope must exceed keep_slope";
  } else {
    return true;
  }
  return false;
}

void AddKinectNoise(const KinectNoiseOptions& options, const PinholeCamera& camera, uint64_t seed,
                    uint64_t frame, std::vector<float>* depth) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("AddKinectNoise: " + error);
  if (depth->size() != static_cast<size_t>(camera.width) * camera.height) {
    throw std::invalid_argument(
        "AddKinectNoise: depth must have camera.width * camera.height values");
  }
  Random random(seed, frame);
  const double pixels_per_sensor_pixel = camera.FocalLength() / options.focal_length;
  const double lateral = options.lateral_sigma * pixels_per_sensor_pixel;
  const std::vector<float> noise = SmoothNoise(
      camera.width, camera.height, options.correlation * pixels_per_sensor_pixel, &random);
  const double depth_times_disparity = options.focal_length * options.baseline;
  const std::vector<float> exact = *depth;
  for (size_t i = 0; i < exact.size(); ++i) {
    const int x = static_cast<int>(i % camera.width), y = static_cast<int>(i / camera.width);
    // Always drawn, so the noise of a pixel does not depend on other pixels.
    const double z = ShiftedDepth(camera, exact, x, y, lateral * random.Normal2());
    const double draw = random.Uniform();
    const double loss = (Slope(camera, exact, x, y) - options.keep_slope) /
                        (options.lose_slope - options.keep_slope);
    (*depth)[i] = 0.0f;
    if (z < options.min_depth || z > options.max_depth || draw < std::min(loss, 0.95)) continue;
    const double disparity = depth_times_disparity / z + options.disparity_sigma * noise[i];
    const double rounded = options.disparity_step * std::round(disparity / options.disparity_step);
    if (rounded > 0.0) (*depth)[i] = static_cast<float>(depth_times_disparity / rounded);
  }
}

}  // namespace msc_vo
