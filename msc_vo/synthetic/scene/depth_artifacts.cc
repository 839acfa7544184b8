// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/depth_artifacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/smooth_noise.h"

namespace msc_vo {

namespace {

constexpr double kReferenceWidth = 640.0;
// Relative difference of depth that makes a depth edge.
constexpr double kEdgeRatio = 0.05;

void Check(bool valid, const char* sensor, const PinholeCamera& camera,
           const std::vector<float>& depth) {
  if (!valid) {
    throw std::invalid_argument(std::string(sensor) +
                                " noise: lengths, sigmas and ratios must not be negative, "
                                "baseline, period and sizes must be positive");
  }
  if (depth.size() != static_cast<size_t>(camera.width) * camera.height) {
    throw std::invalid_argument(std::string(sensor) +
                                " noise: depth must have camera.width * camera.height values");
  }
}

int ScaledRadius(double radius, const PinholeCamera& camera) {
  return static_cast<int>(std::lround(radius * camera.width / kReferenceWidth));
}

// Smallest depth (or largest, if `farthest`) within `radius` pixels in both directions; pixels
// without depth do not count.
std::vector<float> Extreme(const PinholeCamera& camera, const std::vector<float>& depth, int radius,
                           bool farthest) {
  const auto better = [farthest](float a, float b) {
    return b <= 0.0f || (a > 0.0f && (farthest ? a > b : a < b)) ? a : b;
  };
  const int width = camera.width, height = camera.height;
  std::vector<float> rows(depth.size(), 0.0f), all(depth.size(), 0.0f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      float& best = rows[static_cast<size_t>(y) * width + x];
      for (int i = std::max(0, x - radius); i <= std::min(width - 1, x + radius); ++i) {
        best = better(depth[static_cast<size_t>(y) * width + i], best);
      }
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int j = std::max(0, y - radius); j <= std::min(height - 1, y + radius); ++j) {
      for (int x = 0; x < width; ++x) {
        float& best = all[static_cast<size_t>(y) * width + x];
        best = better(rows[static_cast<size_t>(j) * width + x], best);
      }
    }
  }
  return all;
}

// A grid of measurements over the image.
struct Grid {
  int columns = 0;
  int rows = 0;
  std::vector<double> depth;  // metres; 0: none

  // Linear interpolation at pixel (x, y) of an image of the given size; 0 if a neighbour is
  // missing.
  double At(int x, int y, const PinholeCamera& camera) const {
    const double u = std::clamp((x + 0.5) * columns / camera.width - 0.5, 0.0, columns - 1.001);
    const double v = std::clamp((y + 0.5) * rows / camera.height - 0.5, 0.0, rows - 1.001);
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    double sum = 0.0;
    for (const int dj : {0, 1}) {
      for (const int di : {0, 1}) {
        const double z = depth[static_cast<size_t>(j + dj) * columns + i + di];
        if (z <= 0.0) return 0.0;
        sum += z * (di == 0 ? 1.0 - (u - i) : u - i) * (dj == 0 ? 1.0 - (v - j) : v - j);
      }
    }
    return sum;
  }
};

// Mean depth of each cell; 0 where no pixel has a depth.
Grid MeanDepth(const PinholeCamera& camera, const std::vector<float>& depth, int columns) {
  Grid grid;
  grid.columns = std::min(columns, camera.width);
  grid.rows = std::max(2, grid.columns * camera.height / camera.width);
  grid.depth.assign(static_cast<size_t>(grid.columns) * grid.rows, 0.0);
  std::vector<int> counts(grid.depth.size(), 0);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const float z = depth[static_cast<size_t>(y) * camera.width + x];
      if (!(z > 0.0f)) continue;
      const int i = x * grid.columns / camera.width, j = y * grid.rows / camera.height;
      const size_t cell = static_cast<size_t>(j) * grid.columns + i;
      grid.depth[cell] += z;
      ++counts[cell];
    }
  }
  for (size_t i = 0; i < counts.size(); ++i) grid.depth[i] /= std::max(1, counts[i]);
  return grid;
}

}  // namespace

void AddTimeOfFlightNoise(const TimeOfFlightOptions& options, const PinholeCamera& camera,
                          uint64_t seed, uint64_t frame, std::vector<float>* depth) {
  Check(options.sigma >= 0.0 && options.relative_sigma >= 0.0 && options.bias_period > 0.0 &&
            options.flying_radius >= 0.0,
        "time-of-flight", camera, *depth);
  Random random(seed, frame);
  const int radius = std::max(1, ScaledRadius(options.flying_radius, camera));
  const std::vector<float> nearest = Extreme(camera, *depth, radius, false);
  const std::vector<float> farthest = Extreme(camera, *depth, radius, true);
  for (size_t i = 0; i < depth->size(); ++i) {
    // Always drawn, so the noise of a pixel does not depend on other pixels.
    const double noise = random.Normal(), mixture = random.Uniform();
    const double exact = (*depth)[i];
    (*depth)[i] = 0.0f;
    if (!(exact > 0.0) || exact > options.max_depth) continue;
    double z = exact;
    if (farthest[i] - nearest[i] > kEdgeRatio * nearest[i]) {
      z = nearest[i] + mixture * (farthest[i] - nearest[i]);
    }
    z += noise * (options.sigma + options.relative_sigma * z);
    z += options.bias * std::sin(2.0 * kPi * z / options.bias_period);
    (*depth)[i] = static_cast<float>(std::max(z, 0.0));
  }
}

void AddStereoNoise(const StereoOptions& options, const PinholeCamera& camera, uint64_t seed,
                    uint64_t frame, std::vector<float>* depth) {
  Check(options.baseline > 0.0 && options.disparity_sigma >= 0.0 && options.correlation > 0.0 &&
            options.window_radius >= 0.0 && options.hole_ratio >= 0.0 && options.hole_size > 0.0,
        "stereo", camera, *depth);
  Random random(seed, frame);
  const double scale = camera.width / kReferenceWidth;
  const int width = camera.width, height = camera.height;
  const std::vector<float> noise = SmoothNoise(width, height, options.correlation * scale, &random);
  const std::vector<float> hole = SmoothNoise(width, height, options.hole_size * scale, &random);
  const std::vector<float> nearest =
      Extreme(camera, *depth, ScaledRadius(options.window_radius, camera), false);
  // The holes are the lowest values of their field.
  std::vector<float> sorted = hole;
  const auto quantile = static_cast<std::ptrdiff_t>(std::min(options.hole_ratio, 1.0) *
                                                    static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), sorted.begin() + quantile, sorted.end());
  const float hole_limit = sorted[static_cast<size_t>(quantile)];
  const double depth_times_disparity = options.baseline * camera.FocalLength() / scale;
  for (size_t i = 0; i < depth->size(); ++i) {
    const bool measured = (*depth)[i] > 0.0f && hole[i] >= hole_limit;
    (*depth)[i] = 0.0f;
    if (!measured || nearest[i] > options.max_depth) continue;
    const double disparity =
        depth_times_disparity / nearest[i] + options.disparity_sigma * noise[i];
    if (disparity > 0.0) (*depth)[i] = static_cast<float>(depth_times_disparity / disparity);
  }
}

void AddLidarNoise(const LidarOptions& options, const PinholeCamera& camera, uint64_t seed,
                   uint64_t frame, std::vector<float>* depth) {
  Check(options.columns >= 8 && options.sigma >= 0.0 && options.relative_sigma >= 0.0 &&
            options.correlation > 0.0,
        "lidar", camera, *depth);
  Random random(seed, frame);
  Grid grid = MeanDepth(camera, *depth, options.columns);
  const std::vector<float> noise =
      SmoothNoise(grid.columns, grid.rows, options.correlation, &random);
  for (size_t i = 0; i < grid.depth.size(); ++i) {
    double& z = grid.depth[i];
    if (z > 0.0) z += noise[i] * (options.sigma + options.relative_sigma * z);
    if (z > options.max_depth) z = 0.0;
  }
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      (*depth)[static_cast<size_t>(y) * camera.width + x] =
          static_cast<float>(grid.At(x, y, camera));
    }
  }
}

}  // namespace msc_vo
