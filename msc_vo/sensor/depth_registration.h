// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/registration_geometry.h"

namespace msc_vo {

struct SurfaceMap;

/// Registers the images of a depth camera to the raw (distorted) images of a colour camera.
///
/// A depth pixel covers its square of the depth image with the plane through the pixel and those of
/// its neighbours that lie on the same surface. A colour pixel takes the depth of the plane whose
/// point on the viewing ray lies in the square: inverse depth is affine on every plane, so a plane
/// is registered exactly. Where several surfaces cover a colour pixel, the nearest wins. Colour
/// pixels that none covers have no depth, as have those that lie behind a surface on both sides of
/// them, which see the background through a hole of the measurement. If depth pixels are larger
/// than colour pixels, inverse depth is interpolated between colour pixels on one surface, also
/// over a missing depth pixel between them.
class DepthRegistration {
 public:
  /// All arguments must be valid.
  DepthRegistration(const DepthCamera& depth_camera, const PinholeCamera& color,
                    const LensDistortion& color_distortion)
      : geometry_(depth_camera, color, color_distortion) {}

  /// Returns the depth (CV_32FC1, metres along the optical axis of the colour camera, 0: none) of
  /// the pixels of the colour image. `depth`: CV_32FC1, metres; 0, NaN: no measurement.
  /// Thread-safe; every thread that calls it keeps about 16 bytes per depth pixel as buffers.
  /// Throws std::invalid_argument if the size or the type of `depth` is wrong, or if its depths are
  /// raw units of a sensor rather than metres (DepthUnitsError()).
  cv::Mat Register(const cv::Mat& depth) const;

 private:
  struct Strip;

  template <bool kColorLens>
  void ComputeRays(int y, Strip* strip) const;
  template <bool kDepthLens>
  void FindPlanes(const SurfaceMap& surfaces, Strip* strip) const;
  // Writes inverse depths in the colour camera to a row; 0: none; -1: needs a search.
  void MeetPlanes(const SurfaceMap& surfaces, const Strip& strip, float* row) const;
  void InterpolateColumns(const float* sparse, float* row) const;
  void InterpolateRows(const std::vector<float>& above, const std::vector<float>& below,
                       float* row) const;
  // Computes row y before the search; `sparse`: a buffer for every color_step-th pixel.
  void ComputeRow(const SurfaceMap& surfaces, int y, float* sparse, float* row) const;
  // Inverse depth of a ray, divided by (A p)_z, on the surface around its position for the inverse
  // depth `near` of the depth camera; 0: none.
  float Intersect(const SurfaceMap& surfaces, const Eigen::Vector2f& infinity, float near) const;
  // Inverse depth in the colour camera of a pixel by all surfaces around its ray.
  float Search(const SurfaceMap& surfaces, int x, int y) const;
  void SearchRow(const SurfaceMap& surfaces, int y, float* row) const;

  RegistrationGeometry geometry_;
};

}  // namespace msc_vo
