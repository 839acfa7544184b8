// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_alignment.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

namespace {

// Smallest shift that changes the nearest pixel, pixels.
constexpr double kMinShift = 0.5;

// Shift in the image that an angle (radians), or a translation (metres) at one metre, causes,
// pixels.
double Shift(const PinholeCamera& camera, double angle) {
  return std::max(std::abs(camera.fx), std::abs(camera.fy)) * angle;
}

bool IsNegligible(const PinholeCamera& camera, const Rigid3& motion) {
  const double angle = motion.rotation().angularDistance(Eigen::Quaterniond::Identity());
  return Shift(camera, angle + motion.translation().norm()) < kMinShift;
}

// Looks up the depth of pixels of the colour image in the depth image.
class DepthLookup {
 public:
  // `lens`: of the images; null if its effect on shifts is negligible.
  DepthLookup(const PinholeCamera& camera, const LensDistortion* lens, const cv::Mat& depth,
              const Rigid3& motion)
      : camera_(camera), lens_(lens), depth_(depth) {
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
  Eigen::Vector3f Direction(float x, float y) const {
    return homography_ * Eigen::Vector3f(x, y, 1.0f);
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
    if (lens_ != nullptr && !(pixel.z() > 0.0f)) return 0.0f;
    const float scale = 1.0f / pixel.z();
    float x = scale * pixel.x(), y = scale * pixel.y();
    if (lens_ != nullptr) {
      const Eigen::Vector2d raw = lens_->Distort(camera_, {x, y});
      x = static_cast<float>(raw.x());
      y = static_cast<float>(raw.y());
    }
    const int u = cvRound(x);
    const int v = cvRound(y);
    const bool is_inside = u >= 0 && v >= 0 && u < depth_.cols && v < depth_.rows;
    return is_inside ? depth_.at<float>(v, u) : 0.0f;
  }

  const PinholeCamera& camera_;
  const LensDistortion* lens_;
  const cv::Mat& depth_;
  Eigen::Matrix3f homography_;  // at infinity
  Eigen::Vector3f shift_;
  bool has_parallax_;
};

}  // namespace

cv::Mat AlignDepth(const PinholeCamera& camera, const cv::Mat& depth, const Rigid3& motion) {
  if (IsNegligible(camera, motion)) return depth;
  const DepthLookup lookup(camera, nullptr, depth, motion);
  cv::Mat aligned(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    Eigen::Vector3f direction = lookup.Direction(0.0f, static_cast<float>(y));
    float* row = aligned.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x, direction += lookup.DirectionStep()) {
      row[x] = lookup.At(direction);
    }
  }
  return aligned;
}

DepthAligner::DepthAligner(const PinholeCamera& camera, const LensDistortion& distortion)
    : camera_(camera), distortion_(distortion) {
  if (distortion.IsCropped()) undistorted_ = UndistortedPixels(camera, distortion);
}

cv::Mat DepthAligner::Align(const cv::Mat& depth, const Rigid3& motion) const {
  if (undistorted_.empty()) return AlignDepth(camera_, depth, motion);
  if (IsNegligible(distortion_.Recorded(camera_), motion)) return depth;
  const DepthLookup lookup(camera_, &distortion_, depth, motion);
  cv::Mat aligned = cv::Mat::zeros(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const cv::Vec2f& pixel = undistorted_.at<cv::Vec2f>(y, x);
      if (!camera_.IsInside({pixel[0], pixel[1]})) continue;
      aligned.at<float>(y, x) = lookup.At(lookup.Direction(pixel[0], pixel[1]));
    }
  }
  return aligned;
}

}  // namespace msc_vo
