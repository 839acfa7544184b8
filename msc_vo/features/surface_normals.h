// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

struct SurfaceNormalOptions {
  double min_depth = 0.2;  ///< metres; depth outside [min_depth, max_depth] is invalid
  double max_depth = 10.0;

  bool IsValid(std::string* error) const;
};

struct SurfaceNormal {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, camera frame, towards the camera
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< metres, camera frame: window's mean
  double sigma = 0.0;                                   ///< radians, per component of direction
};

class DepthSums;

/// Estimates surface normals on a grid over the depth image with integral images: the cross product
/// of a horizontal and a vertical tangent, each the difference between the mean points of the two
/// halves of a window (after Holz et al. 2011, "average 3D gradient"; paper: Manhattan Axes
/// Estimation).
///
/// The mean of any points of a plane lies on that plane, so missing depth does not bias a normal.
/// Windows shrink until they contain no depth edge. Images wider than 640 pixels are reduced to
/// every second, third, ... pixel. Keeps its buffers between calls; not thread-safe.
class SurfaceNormalEstimator {
 public:
  /// The window grows with depth until depth noise tilts a normal by at most this standard
  /// deviation, radians (2 degrees).
  static constexpr double kTargetSigma = 0.035;
  /// Random part of the noise of 1/z, standard deviation in 1/metres: that of a Kinect (Khoshelham
  /// and Elberink 2012).
  static constexpr double kInverseDepthSigma = 1.4e-3;

  /// `distortion` is that of the raw depth image. Throws std::invalid_argument on invalid options
  /// or an invalid camera.
  SurfaceNormalEstimator(const SurfaceNormalOptions& options, const PinholeCamera& camera,
                         const LensDistortion& distortion);
  ~SurfaceNormalEstimator();

  /// `depth` is the raw image, not undistorted: CV_32FC1, metres along the optical axis, 0 where
  /// nothing was measured. Normals are ordered row by row; grid points without a normal are
  /// omitted. Throws std::invalid_argument if type or size of the image do not match the camera.
  std::vector<SurfaceNormal> Estimate(const cv::Mat& depth);

 private:
  struct Window;

  cv::Mat Reduce(const cv::Mat& depth) const;
  // All images and lengths below are those of the reduced image.
  void Integrate(const cv::Mat& depth);
  DepthSums SumOver(int left, int top, int right, int bottom) const;
  double NormalSigma(double z, double radius) const;
  bool SelectWindow(int x, int y, double z, Window* window) const;
  bool EstimateInWindow(const Window& window, SurfaceNormal* normal) const;

  SurfaceNormalOptions options_;
  PinholeCamera camera_;  // of the whole image, undistorted
  int step_ = 1;          // pixels of the whole image per pixel of the reduced one
  int width_ = 0;
  int height_ = 0;
  double focal_length_ = 0.0;
  double correlation_length_ = 0.0;
  int min_radius_ = 0;
  int max_radius_ = 0;
  std::vector<std::array<float, 2>> rays_;  // x / z and y / z of each pixel
  std::vector<DepthSums> integral_;         // (height + 1) x (width + 1)
};

}  // namespace msc_vo
