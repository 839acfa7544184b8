// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// One pinhole camera for the images of a recording whose intrinsics change from image to image, as
/// those of a telephone do when it focuses. Images whose pixels are displaced by more than
/// kMaxDisplacement are resampled to it; the others are used as they are.
class CommonCamera {
 public:
  /// Displacement that is left alone, pixels of an image kReferenceWidth wide. Chosen by
  /// measurement, see docs/lab/phones.md.
  static constexpr double kMaxDisplacement = 0.25;
  static constexpr double kReferenceWidth = 1280.0;

  /// `cameras`: those of all images, of one size; at least one. Takes the median of each number.
  explicit CommonCamera(std::vector<PinholeCamera> cameras);

  const PinholeCamera& camera() const { return camera_; }
  /// Number of images that are resampled, and the largest displacement of a pixel, reference
  /// pixels.
  int num_resampled() const { return num_resampled_; }
  double largest_displacement() const { return largest_displacement_; }

  /// Whether image i is resampled.
  bool Resamples(int i) const { return Displacement(i) > kMaxDisplacement; }
  /// Returns an image of the view of colour image i, of any size, as the common camera would have
  /// taken it. `interpolation`: of OpenCV; pixels outside the image have the value of the nearest
  /// pixel, or `outside` with nearest neighbours.
  cv::Mat Resample(int i, const cv::Mat& image, int interpolation, int outside = 0) const;

 private:
  double Displacement(int i) const;

  std::vector<PinholeCamera> cameras_;
  PinholeCamera camera_;
  int num_resampled_ = 0;
  double largest_displacement_ = 0.0;
};

}  // namespace msc_vo
