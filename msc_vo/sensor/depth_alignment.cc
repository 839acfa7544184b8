// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_alignment.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace msc_vo {

namespace {

// Smallest shift that changes the nearest pixel, pixels.
constexpr double kMinShift = 0.5;

// Shift in the image that an angle (radians), or a translation (metres) at one metre, causes,
// pixels.
double Shift(const PinholeCamera& camera, double angle) {
  return std::max(std::abs(camera.fx), std::abs(camera.fy)) * angle;
}

// Looks up the depth of pixels of the colour image in the depth image.
class DepthLookup {
 public:
  DepthLookup(const PinholeCamera& camera, const cv::Mat& depth, const Rigid3& motion)
      : depth_(depth) {
    Eigen::Matrix3d intrinsics;
    intrinsics << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
    homography_ =
        (intrinsics * motion.rotation().toRotationMatrix() * intrinsics.inverse()).cast<float>();
    shift_ = (intrinsics * motion.translation()).cast<float>();
    has_parallax_ = Shift(camera, motion.translation().norm()) >= kMinShift;
  }

  // Homogeneous pixel of the depth image that corresponds to (x, y) at infinity, and its change
  // with x. The pixel that corresponds to (x, y) at depth z is z times this vector plus shift_,
  // whose third coordinate is the depth in the depth image.
  Eigen::Vector3f Direction(int x, int y) const {
    return homography_ * Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 1.0f);
  }
  Eigen::Vector3f DirectionStep() const { return homography_.col(0); }

  // Returns the depth along a direction, 0 if there is none: looked up at infinity first, then at
  // the depth found there.
  float At(const Eigen::Vector3f& direction) const {
    float depth = Nearest(direction);
    if (has_parallax_ && depth > 0.0f) depth = Nearest(depth / direction.z() * direction + shift_);
    return depth > shift_.z() && depth > 0.0f ? (depth - shift_.z()) / direction.z() : 0.0f;
  }

 private:
  float Nearest(const Eigen::Vector3f& pixel) const {
    const float scale = 1.0f / pixel.z();
    const int u = cvRound(scale * pixel.x());
    const int v = cvRound(scale * pixel.y());
    const bool is_inside = u >= 0 && v >= 0 && u < depth_.cols && v < depth_.rows;
    return is_inside ? depth_.at<float>(v, u) : 0.0f;
  }

  const cv::Mat& depth_;
  Eigen::Matrix3f homography_;  // at infinity
  Eigen::Vector3f shift_;
  bool has_parallax_;
};

}  // namespace

cv::Mat AlignDepth(const PinholeCamera& camera, const cv::Mat& depth, const Rigid3& motion) {
  const double angle = motion.rotation().angularDistance(Eigen::Quaterniond::Identity());
  if (Shift(camera, angle + motion.translation().norm()) < kMinShift) return depth;
  const DepthLookup lookup(camera, depth, motion);
  cv::Mat aligned(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    Eigen::Vector3f direction = lookup.Direction(0, y);
    float* row = aligned.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x, direction += lookup.DirectionStep()) {
      row[x] = lookup.At(direction);
    }
  }
  return aligned;
}

}  // namespace msc_vo
