// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/sensor/registration_geometry.h"

namespace msc_vo {

/// The surfaces of a depth image as the colour camera sees them: the plane of every depth pixel,
/// and the nearest surfaces at every place of the depth image at infinity. The buffers keep their
/// memory from image to image.
struct SurfaceMap {
  /// Inverse depth in the colour camera, divided by (A p)_z, of the viewing ray of colour pixel p:
  /// x q_inf,x + y q_inf,y + z, see RegistrationGeometry. All 0: no depth. Four values, so that one
  /// cache line has all.
  struct Plane {
    float x, y, z, unused;
  };

  /// Computes the map of a depth image (CV_32FC1, metres; 0, NaN: no measurement).
  void Compute(const RegistrationGeometry& geometry, const cv::Mat& depth);

  /// Of pixel (u, v) is element (v + 1) * (width + 2) + u + 1; the border has no depth.
  std::vector<Plane> planes;
  /// Largest inverse depth (of the depth camera, 1/metres; 0: none) of the cell of the grid, its
  /// right neighbour, and those below both.
  std::vector<float> nearest;

 private:
  struct Row;

  void AddRow(const RegistrationGeometry& geometry, int v, const float* above, const float* here,
              const float* below, Row* row);
  void SpreadNearest(const RegistrationGeometry::Grid& grid);
};

}  // namespace msc_vo
