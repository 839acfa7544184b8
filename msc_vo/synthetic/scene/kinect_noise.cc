// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/kinect_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/smooth_noise.h"

namespace msc_vo {

namespace {

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
