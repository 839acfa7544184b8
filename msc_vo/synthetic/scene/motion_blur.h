// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Motion blur is the mean of images rendered at times that divide the exposure time evenly.

/// Returns the largest displacement of a pixel, in pixels, that a camera sees when it moves from
/// pose a to pose b. `depth`: metres at a, camera.width * camera.height values, 0: none. A lens
/// distortion is ignored.
double LargestImageMotion(const PinholeCamera& camera, const std::vector<float>& depth,
                          const Rigid3& b_from_a);

/// Number of images whose mean blurs a displacement of `motion` pixels without gaps: one per pixel,
/// from 1 (no blur) to 32.
int NumExposureSamples(double motion);

/// Mean of images of equal size.
class ImageMean {
 public:
  void Add(const std::vector<uint8_t>& values);
  /// The rounded mean of all images; needs at least one.
  std::vector<uint8_t> Value() const;

 private:
  std::vector<uint32_t> sums_;
  uint32_t count_ = 0;
};

}  // namespace msc_vo
