// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/sensor/depth_camera.h"

namespace msc_vo {

/// Largest difference of inverse depths on one surface, as a ratio: a plane seen at 87 degrees
/// changes by as much from pixel to pixel.
inline constexpr float kMaxSurfaceRatio = 0.04f;
/// Differences of inverse depths that the noise of a sensor explains, 1/metres.
inline constexpr float kMaxSurfaceNoise = 0.006f;

/// Largest difference of inverse depths on one surface, 1/metres.
inline float EdgeThreshold(float inverse_depth) {
  return std::max(kMaxSurfaceNoise, kMaxSurfaceRatio * inverse_depth);
}

/// Half the side of the square that a depth pixel covers, pixels. The part above 0.5 closes the
/// gaps that noise opens between neighbours on a surface.
inline constexpr float kHalfSide = 0.6f;

/// Smallest z of a viewing ray of the colour camera in the depth camera frame.
inline constexpr float kMinRayZ = 0.01f;

/// The two cameras of a DepthRegistration.
///
/// Positions q in the undistorted depth image are relative to the centre of the depth image. The
/// surface point at q with inverse depth w (of the depth camera) lies on the viewing ray of colour
/// pixel p, and has the inverse depth w_c in the colour camera, if
///
///   q_inf = (q + w e_xy) / (1 + w e_z),   q_inf = (A p)_xy / (A p)_z,
///   w_c = (A p)_z w / (1 + w e_z)
///
/// for the homogeneous pixel p. A maps p to the depth image for points at infinity, and e is the
/// homogeneous image of the baseline.
struct RegistrationGeometry {
  /// Values of the pixels of an image, or of one row of it that is the same in all.
  struct Field {
    cv::Mat values;  ///< CV_32FC1
    const float* Row(int v) const { return values.ptr<float>(values.rows > 1 ? v : 0); }
  };
  /// Regular cells in the depth image at infinity, around all that the colour camera sees. They
  /// have the size of the square that a depth pixel covers, so that the four cells around a
  /// position have all depth pixels that may cover it. Two rows and columns at every border see
  /// nothing.
  struct Grid {
    Eigen::Vector2f origin = Eigen::Vector2f::Zero();  ///< of the first cell
    float cells_per_pixel = 0.0f;
    int width = 0, height = 0;

    /// Index of the first of the four cells around a position, not at the border.
    int IndexAround(const Eigen::Vector2f& position) const;
  };

  RegistrationGeometry(const DepthCamera& depth_camera, const PinholeCamera& color,
                       const LensDistortion& color_distortion);

  bool HasDepthLens() const { return depth_x.values.rows > 1; }
  bool HasColorLens() const { return color_x.values.rows > 1; }
  /// Undistorted colour pixel.
  Eigen::Vector2f ColorPixel(int x, int y) const;
  /// What to add to depth_y in a row.
  float DepthRowOffset(int v) const {
    return HasDepthLens() ? 0.0f : static_cast<float>(v) - center.y();
  }
  /// Displacement of a position in the depth image by the lens.
  Eigen::Vector2f DepthLensOffset(float x, float y) const;

  int width, height;              ///< of the depth image
  int color_width, color_height;  ///< of the colour image
  Eigen::Matrix3f matrix;         ///< A
  Eigen::Vector3f epipole;        ///< e
  Eigen::Vector2f center;         ///< of the depth image, pixels
  float inverse_depth_offset;
  /// Change of the inverse depth (of the depth camera) that moves a point by a depth pixel.
  float inverse_depth_per_pixel;
  float magnification;  ///< size of a depth pixel in the colour image, pixels
  /// Distance of the colour pixels in a row that are projected onto the surfaces.
  int color_step;
  /// These undistorted colour pixels; y is relative to the row without a lens.
  Field color_x, color_y;
  Field depth_x, depth_y;  ///< positions of the depth pixels
  /// Transposed inverse of the derivative of the positions of depth pixels; CV_32FC4, row by row.
  cv::Mat depth_derivative;
  Grid grid;

 private:
  void SetDepthPixels(const DepthCamera& depth_camera);
  void SetDepthLens(const DepthCamera& depth_camera);
  void SetColorPixels(const PinholeCamera& color, const LensDistortion& lens);
  void SetGrid();

  cv::Mat color_pixels_;  // CV_32FC2, undistorted; empty without a lens
  cv::Mat lens_offset_;   // CV_32FC2, at every kLensStep-th position of the depth image
  Eigen::Vector2f lens_origin_;
};

}  // namespace msc_vo
