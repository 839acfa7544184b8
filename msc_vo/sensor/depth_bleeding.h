// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Estimates by how many pixels near surfaces extend beyond their outline in depth images of a
/// sensor that matches windows: the nearest surface in the window wins (foreground fattening). The
/// outline is where the image has its edge. At every depth edge along rows and columns, the
/// gradient of the image is summed over its distance from the depth edge, towards the nearer
/// surface; the maximum of the sum is the reach. A shift between the two images moves left and
/// right edges in opposite directions and leaves the reach unchanged.
class BleedingEstimator {
 public:
  /// `width`: of the images, pixels.
  explicit BleedingEstimator(int width);

  /// Adds the edges of an image: CV_8UC1 grey, CV_32FC1 depth in metres, of equal size.
  void Add(const cv::Mat& gray, const cv::Mat& depth);
  /// True if there are so many edges that further images change the reach little.
  bool IsDone() const;
  /// Pixels, at most 1/64 of the width of the image; a typical value as long as there are few
  /// edges.
  int reach() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [max_reach, num_edges, gradient] = *this;  // all members, or it does not compile
    archive(num_edges, gradient);
  }

 private:
  void AddRows(const cv::Mat& gradient, const cv::Mat& inverse_depth);

  int max_reach_;
  int num_edges_ = 0;
  std::vector<double> gradient_;  // sum at distances -max_reach_ to max_reach_
};

/// Returns the depth image (CV_32FC1, metres, finite) with the farthest depth within `reach` pixels
/// at every measured pixel, which takes back what nearer surfaces gained: a surface that extends by
/// `reach` gets its outline back, and an inclined one its place. Pixels without a measurement stay
/// without. `sigma` is the noise of a pixel (1/metres): the farthest depth has the lowest noise,
/// which is corrected.
cv::Mat RemoveBleeding(const cv::Mat& depth, int reach, double sigma);

}  // namespace msc_vo
