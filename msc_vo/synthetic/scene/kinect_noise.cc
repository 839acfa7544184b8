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

// Random numbers of a pixel.
struct PixelDraw {
  Eigen::Vector2d shift;  // standard normal
  double uniform = 0.0;   // in [0, 1)
  float noise = 0.0f;     // standard normal, correlated between pixels
};

void Check(const KinectNoiseOptions& options, const PinholeCamera& camera,
           const std::vector<float>& depth) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("AddKinectNoise: " + error);
  if (depth.size() != static_cast<size_t>(camera.width) * camera.height) {
    throw std::invalid_argument(
        "AddKinectNoise: depth must have camera.width * camera.height values");
  }
}

// Applies the noise; `draw_of` returns the random numbers of each pixel, in order.
template <typename DrawOf>
void Apply(const KinectNoiseOptions& options, const PinholeCamera& camera,
           std::vector<float>* depth, const DrawOf& draw_of) {
  const double lateral = options.lateral_sigma * (camera.FocalLength() / options.focal_length);
  const Eigen::Vector2d offset =
      options.lateral_offset * (camera.FocalLength() / options.focal_length);
  const double depth_times_disparity = options.focal_length * options.baseline;
  const std::vector<float> exact = *depth;
  for (size_t i = 0; i < exact.size(); ++i) {
    const int x = static_cast<int>(i % camera.width), y = static_cast<int>(i / camera.width);
    const PixelDraw draw = draw_of(i);
    const double z = ShiftedDepth(camera, exact, x, y, lateral * draw.shift + offset);
    const double loss = (Slope(camera, exact, x, y) - options.keep_slope) /
                        (options.lose_slope - options.keep_slope);
    (*depth)[i] = 0.0f;
    if (z < options.min_depth || z > options.max_depth) continue;
    if (draw.uniform < std::min(loss, 0.95)) continue;
    const double disparity =
        depth_times_disparity / z + options.disparity_sigma * draw.noise + options.disparity_bias;
    const double rounded = options.disparity_step * std::round(disparity / options.disparity_step);
    if (rounded > 0.0) (*depth)[i] = static_cast<float>(depth_times_disparity / rounded);
  }
}

}  // namespace

KinectNoiseOptions IclNuimNoise() {
  KinectNoiseOptions options;
  options.disparity_step = options.focal_length * options.baseline / 351.3;
  options.disparity_sigma = options.disparity_step / 6.0;
  options.disparity_bias = 0.5 * options.disparity_step;
  options.correlation = 0.1;  // neighbouring pixels are independent
  options.min_depth = 0.0;
  options.max_depth = 20.0;
  options.keep_slope = 1e6;
  options.lose_slope = 2e6;
  return options;
}

bool KinectNoiseOptions::IsValid(std::string* error) const {
  if (!(focal_length > 0.0 && baseline > 0.0 && disparity_step > 0.0 && correlation > 0.0)) {
    *error = "kinect noise: focal_length, baseline, disparity_step, correlation must be positive";
  } else if (!(lateral_sigma >= 0.0 && disparity_sigma >= 0.0)) {
    *error = "kinect noise: lateral_sigma and disparity_sigma must not be negative";
  } else if (!(std::abs(disparity_bias) <= 1.0 && lateral_offset.norm() <= 100.0)) {
    *error = "kinect noise: disparity_bias must be from -1 to 1, lateral_offset at most 100 pixels";
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
  Check(options, camera, *depth);
  Random random(seed, frame);
  const double pixels_per_sensor_pixel = camera.FocalLength() / options.focal_length;
  const std::vector<float> noise = SmoothNoise(
      camera.width, camera.height, options.correlation * pixels_per_sensor_pixel, &random);
  // Always drawn, so the noise of a pixel does not depend on other pixels.
  Apply(options, camera, depth, [&](size_t pixel) {
    const Eigen::Vector2d shift = random.Normal2();
    return PixelDraw{shift, random.Uniform(), noise[pixel]};
  });
}

NoiseTable::NoiseTable(const KinectNoiseOptions& options, const PinholeCamera& camera,
                       uint64_t seed)
    : width_(camera.width), height_(camera.height), seed_(seed) {
  Random random(seed, 0x7461626c65);
  normals_.resize(kSize);
  for (float& value : normals_) value = static_cast<float>(random.Normal());
  smooth_ = SmoothNoise(width_, height_,
                        options.correlation * camera.FocalLength() / options.focal_length, &random);
}

void NoiseTable::AddKinectNoise(const KinectNoiseOptions& options, const PinholeCamera& camera,
                                uint64_t frame, std::vector<float>* depth) const {
  Check(options, camera, *depth);
  Random random(seed_, frame);
  const size_t start = static_cast<size_t>(random.Next());
  const size_t shift = static_cast<size_t>(random.Index(width_ * height_));
  Apply(options, camera, depth, [&](size_t pixel) {
    const size_t at = start + 2 * pixel;
    const double uniform = static_cast<double>(MixBits(at) >> 11) * 0x1p-53;
    return PixelDraw{{normals_[at % kSize], normals_[(at + 1) % kSize]},
                     uniform,
                     smooth_[(pixel + shift) % smooth_.size()]};
  });
}

void NoiseTable::AddImageNoise(double sigma, uint64_t frame, RenderedImage* image) const {
  size_t at = static_cast<size_t>(Random(seed_, frame).Next());
  for (size_t i = 0; i < image->rgb.size(); i += 3, ++at) {
    const float noise = static_cast<float>(sigma) * normals_[at % kSize];
    for (size_t k = i; k < i + 3; ++k) image->rgb[k] = ToGrayValue(image->rgb[k] + noise);
  }
}

}  // namespace msc_vo
