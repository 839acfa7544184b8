// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

struct SurfaceNormalOptions {
  int grid_step = 16;  // pixels between the normals: 1200 of them at 640x480
  // The window grows with depth until the sensor's noise tilts a normal by no more than this.
  double target_sigma = 0.035;  // radians, 2 degrees
  // Standard deviation of 1/z, 1/metres: the random part of a Kinect's (Khoshelham and Elberink
  // 2012); and the distance from which on pixels err on their own, pixels: its matching window is
  // 9 pixels wide and errors within half of it are alike.
  double inverse_depth_sigma = 1.4e-3;
  double correlation = 5.0;
  int min_radius = 5;   // pixels; smaller windows hold too few pixels to average anything
  int max_radius = 32;  // pixels; larger ones look across the things in a room
  // Surfaces seen at a flatter angle than this look like a depth edge, and depth on them is poor.
  double max_incidence = 1.396;  // radians between ray and normal, 80 degrees
  double min_valid = 0.5;        // of the window's pixels must have a depth
  double min_depth = 0.2;        // metres; depth outside [min_depth, max_depth] is invalid
  double max_depth = 10.0;

  bool IsValid(std::string* error) const;
};

struct SurfaceNormal {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, camera frame, towards the camera
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   // metres, camera frame: mean of the window
  double sigma = 0.0;                                   // radians, of the direction, per component
};

// Surface normals on a grid over the depth image by integral images: the cross product of a
// horizontal and a vertical tangent, each the difference between the mean points of the two halves
// of a window (after Holz et al. 2011, "average 3D gradient"; paper: Manhattan Axes Estimation).
//
// Any mean of points of a plane lies on that plane, so that missing depth does not bend a normal.
// Windows shrink until no depth edge is in them. Keeps its buffers between calls; not for use from
// several threads at once.
class SurfaceNormalEstimator {
 public:
  // Throws std::invalid_argument on options or a camera that are not valid.
  SurfaceNormalEstimator(const SurfaceNormalOptions& options, const PinholeCamera& camera,
                         const LensDistortion& distortion);

  // `depth` is CV_32FC1, metres along the optical axis, 0: none; raw, as the lens sees it. Normals
  // come row by row; grid points without one are left out.
  // Throws std::invalid_argument if the image's type or size is not the camera's.
  std::vector<SurfaceNormal> Estimate(const cv::Mat& depth);

 private:
  // Sums over pixels: x, y, z in units of kUnit; pixels with depth (low half) and depth edges (high
  // half). Wrap around, which leaves the sum over a window right: it fits.
  using Sums = std::array<uint32_t, 4>;
  struct Window;

  void Integrate(const cv::Mat& depth);
  double Sigma(double z, double radius) const;
  Sums SumOver(int left, int top, int right, int bottom) const;
  bool FitWindow(int x, int y, double z, Window* window) const;
  bool NormalAt(const Window& window, SurfaceNormal* normal) const;

  SurfaceNormalOptions options_;
  PinholeCamera camera_;
  std::vector<std::array<float, 2>> rays_;  // x / z and y / z of each pixel
  std::vector<Sums> integral_;              // (height + 1) x (width + 1)
};

}  // namespace msc_vo
