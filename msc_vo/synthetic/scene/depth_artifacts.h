// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// Depth sensors other than a Kinect (kinect_noise.h). Lengths in pixels refer to images of 640
/// pixels width and are scaled to the size of the rendered image. All functions take exact depth
/// (metres along z, row by row, 0: none), are deterministic for a given seed and frame, and throw
/// std::invalid_argument on invalid options or a buffer of the wrong size.

/// Time of flight: noise that grows with distance and is independent between pixels, a smooth error
/// of range, and mixtures of both surfaces beside depth edges.
struct TimeOfFlightOptions {
  double sigma = 0.0015;           ///< metres, constant part of the noise
  double relative_sigma = 0.0025;  ///< metres per metre
  double bias = 0.005;             ///< metres, amplitude of the error of range
  double bias_period = 4.0;        ///< metres
  double flying_radius = 1.5;      ///< pixels, of the mixtures around a depth edge
  double max_depth = 8.0;          ///< metres
};
void AddTimeOfFlightNoise(const TimeOfFlightOptions& options, const PinholeCamera& camera,
                          uint64_t seed, uint64_t frame, std::vector<float>* depth);

/// Active stereo: the disparity of the nearest surface in the matching window, with noise that is
/// correlated over the window, and holes where the matching fails.
struct StereoOptions {
  double baseline = 0.05;         ///< metres
  double disparity_sigma = 0.08;  ///< pixels of a sensor with 640 pixels width
  double correlation = 4.0;       ///< pixels, sigma of the Gaussian that smooths the noise
  double window_radius = 4.0;     ///< pixels
  double hole_ratio = 0.1;        ///< of the image
  double hole_size = 10.0;        ///< pixels, sigma of the Gaussian that smooths the holes
  double max_depth = 8.0;         ///< metres
};
void AddStereoNoise(const StereoOptions& options, const PinholeCamera& camera, uint64_t seed,
                    uint64_t frame, std::vector<float>* depth);

/// LiDAR of a telephone: a coarse grid of mean depths with smooth errors, interpolated linearly.
struct LidarOptions {
  int columns = 192;              ///< of the grid
  double sigma = 0.004;           ///< metres
  double relative_sigma = 0.002;  ///< metres per metre
  double correlation = 4.0;       ///< cells of the grid
  double max_depth = 5.0;         ///< metres
};
void AddLidarNoise(const LidarOptions& options, const PinholeCamera& camera, uint64_t seed,
                   uint64_t frame, std::vector<float>* depth);

}  // namespace msc_vo
