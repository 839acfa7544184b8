// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

/// Noise model of a structured-light depth sensor as in ICL-NUIM (Handa et al. 2014), after
/// Khoshelham and Elberink (2012): depth is looked up at a perturbed pixel and converted to
/// disparity, which is disturbed by correlated noise, rounded and converted back. The noise is
/// uniform in disparity and therefore grows with z^2.
struct KinectNoiseOptions {
  /// Focal length of the sensor, pixels. Pixels below are those of the sensor, regardless of the
  /// size of the rendered image.
  double focal_length = 525.0;
  double baseline = 0.075;        ///< metres, projector to camera
  double lateral_sigma = 0.5;     ///< pixels, perturbation of the position
  double disparity_sigma = 0.05;  ///< pixels
  double correlation = 1.5;       ///< pixels, sigma of the Gaussian that smooths disparity noise
  double disparity_step = 0.125;  ///< pixels, resolution of the Kinect
  /// Added to the disparity before it is rounded, pixels.
  double disparity_bias = 0.0;
  /// Displacement of the depth image, pixels: the depth of pixel p is looked up at p + offset.
  Eigen::Vector2d lateral_offset = Eigen::Vector2d::Zero();
  double min_depth = 0.4;  ///< metres
  double max_depth = 5.0;  ///< metres
  /// Depth is lost on steep surfaces and at depth edges. The probability increases linearly from 0
  /// at keep_slope to 0.95 near lose_slope. A slope is the tangent of the angle between the ray and
  /// the surface normal: 3 is 72 degrees, 9 is 84 degrees.
  double keep_slope = 3.0;
  double lose_slope = 9.0;

  bool IsValid(std::string* error) const;
};

/// The noise of the noisy sequences of ICL-NUIM, with the constants of its published generator:
/// depth is shuffled by 0.5 pixels; inverse depth has steps of 1/351.3 1/m, noise of a sixth of a
/// step, and is rounded half a step upwards; no lost pixels. The generator also copies depth within
/// windows of 9 x 9 pixels, which displaces it; lateral_offset stands for that.
KinectNoiseOptions IclNuimNoise();

/// Applies the noise model to exact depth (metres along z, row by row, 0: none; camera.width *
/// camera.height values). Deterministic for a given seed and frame. Throws std::invalid_argument on
/// invalid options or a buffer of the wrong size.
void AddKinectNoise(const KinectNoiseOptions& options, const PinholeCamera& camera, uint64_t seed,
                    uint64_t frame, std::vector<float>* depth);

/// Noise of all images of a sequence from one table of random numbers, which each image reads from
/// another place: the same noise in a tenth of the time, but not independent between images.
class NoiseTable {
 public:
  NoiseTable(const KinectNoiseOptions& options, const PinholeCamera& camera, uint64_t seed);

  void AddKinectNoise(const KinectNoiseOptions& options, const PinholeCamera& camera,
                      uint64_t frame, std::vector<float>* depth) const;
  /// Normal noise of `sigma` grey values, the same deviate to the three colours of a pixel.
  void AddImageNoise(double sigma, uint64_t frame, RenderedImage* image) const;

 private:
  static constexpr size_t kSize = size_t{1} << 17;

  int width_, height_;
  uint64_t seed_;
  std::vector<float> normals_, smooth_;
};

}  // namespace msc_vo
