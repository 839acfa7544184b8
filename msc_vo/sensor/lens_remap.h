// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

// Between the raw image of a lens and the ideal image of its pinhole camera (same size and
// intrinsics). Without distortion both are the same and nothing is computed.
//
// Why lines are detected in the ideal image while points are detected in the raw one and moved: a
// straight 3-D line is a curve in a distorted image, so that a line detector there finds pieces of
// it, or chords of it with a bias of the curve's height, and no undistortion of end points repairs
// that. A point is moved exactly, and keeps the contrast that interpolation would take.
class LensRemap {
 public:
  LensRemap(const PinholeCamera& camera, const LensDistortion& distortion);

  // The ideal image of a raw one, bilinear. Returns the raw one itself if there is no distortion.
  cv::Mat Undistort(const cv::Mat& raw) const;

  // CV_8UC1, 255 where the ideal image shows something that the raw one saw; empty: everywhere.
  const cv::Mat& mask() const { return mask_; }

  Eigen::Vector2d IdealFromRaw(const Eigen::Vector2d& pixel) const {
    return distortion_.Undistort(camera_, pixel);
  }
  Eigen::Vector2d RawFromIdeal(const Eigen::Vector2d& pixel) const {
    return distortion_.IsZero() ? pixel : distortion_.Distort(camera_, pixel);
  }

 private:
  PinholeCamera camera_;
  LensDistortion distortion_;
  cv::Mat map_;       // CV_16SC2, whole pixels; and
  cv::Mat fraction_;  // CV_16UC1, their fractions: the pair cv::remap is fastest with
  cv::Mat mask_;
};

}  // namespace msc_vo
