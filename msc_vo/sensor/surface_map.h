// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/registration_geometry.h"

namespace msc_vo {

/// The surfaces of a depth image as the colour camera sees them: the plane of every depth pixel,
/// and the nearest surface at every place of the depth image at infinity. The buffers keep their
/// memory from image to image.
struct SurfaceMap {
  /// Computes the map of a depth image (CV_32FC1, metres; 0, NaN: no measurement).
  void Compute(const RegistrationGeometry& geometry, const cv::Mat& depth);

  /// Inverse depth of a viewing ray in the colour camera, divided by (A p)_z, see
  /// RegistrationGeometry; 0: no depth.
  float InverseDepth(int pixel, float x_inf, float y_inf) const {
    return plane_x[pixel] * x_inf + plane_y[pixel] * y_inf + plane_1[pixel];
  }

  /// Coefficients of InverseDepth(). Of pixel (u, v) is element (v + 1) * (width + 2) + u + 1; the
  /// border has no depth.
  std::vector<float> plane_x, plane_y, plane_1;
  /// Largest inverse depth (of the depth camera, 1/metres; 0: none) of the cell of the grid, its
  /// right neighbour, and those below both.
  std::vector<float> nearest;

 private:
  struct Row;

  void Reset(const RegistrationGeometry& geometry);
  void AddRow(const RegistrationGeometry& geometry, int v, Row* row);
  void AddToGrid(const RegistrationGeometry& geometry, int v, Row* row);
  void SpreadNearest(const RegistrationGeometry::Grid& grid);
};

}  // namespace msc_vo
