// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/synthetic/scene/renderer.h"

namespace msc_vo {

/// Makes the images of a camera with a lens from renderings of a larger pinhole image.
class LensWarp {
 public:
  /// Pixels at a larger angle from the optical axis stay black and without depth, degrees.
  static constexpr double kMaxAngle = 75.0;

  /// `recorded`: intrinsics of the recorded image; `lens`: without LensDistortion::recorded. Both
  /// must be valid.
  LensWarp(const PinholeCamera& recorded, const LensDistortion& lens);

  /// The camera to render with: it sees everything that the lens sees, with pixels that are nowhere
  /// larger than those of the recorded image.
  const PinholeCamera& source() const { return source_; }

  /// Returns the recorded image of a rendering with source(). A colour is the mean of four samples
  /// of the pixel. A depth is that of the pixel's centre, exact on planes, and never a mean of two
  /// surfaces.
  RenderedImage Warp(const RenderedImage& rendering) const;

 private:
  int width_;
  int height_;
  PinholeCamera source_;
  std::vector<Eigen::Vector2f> centers_;  // source pixel of every pixel; negative: black
  std::vector<Eigen::Vector2f> samples_;  // four per pixel
};

}  // namespace msc_vo
