// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace msc_vo {

/// A depth image as inverse depths, 1/metres; 0 where there is no valid depth: outside the image,
/// outside [min_depth, max_depth], not measured or NaN.
///
/// Inverse depth is affine in the image on every plane, and its noise is uniform.
class InverseDepthImage {
 public:
  /// An empty image, which has no depth anywhere.
  InverseDepthImage() = default;
  /// See Assign().
  InverseDepthImage(const cv::Mat& depth, double min_depth, double max_depth) {
    Assign(depth, min_depth, max_depth);
  }

  /// Inverts `depth` (CV_32FC1, metres); depths outside [min_depth, max_depth] (metres) are
  /// invalid. Reuses the memory if the size is unchanged.
  void Assign(const cv::Mat& depth, double min_depth, double max_depth);

  /// Inverse depth of pixel (x, y), 1/metres.
  double At(int x, int y) const {
    const bool inside = x >= 0 && y >= 0 && x < image_.cols && y < image_.rows;
    return inside ? image_.at<float>(y, x) : 0.0;
  }
  /// True if the pixel nearest to `pixel` lies inside the image.
  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < image_.cols - 0.5 &&
           pixel.y() < image_.rows - 0.5;
  }
  /// Inverse depth at the pixel nearest to `pixel`, 1/metres.
  double Nearest(const Eigen::Vector2d& pixel) const {
    return At(cvRound(pixel.x()), cvRound(pixel.y()));
  }

 private:
  cv::Mat image_;  // CV_32FC1
};

}  // namespace msc_vo
