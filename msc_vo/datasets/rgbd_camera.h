// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace msc_vo {

/// A pair of images from a live camera.
struct CameraImage {
  double timestamp = 0.0;    ///< seconds, of the colour image
  double depth_delay = 0.0;  ///< seconds from the colour image to the depth image
  cv::Mat color;             ///< 8 bits, 1 or 3 (BGR) channels
  cv::Mat depth;             ///< CV_16UC1, raw units, registered to the colour image
};

/// A live RGB-D camera.
class RgbdCamera {
 public:
  virtual ~RgbdCamera() = default;

  /// Waits for the next pair of images; the matrices of `image` get new memory. Returns false at
  /// the end, which real cameras do not have. Throws std::runtime_error if the camera fails.
  virtual bool Grab(CameraImage* image) = 0;
};

}  // namespace msc_vo
