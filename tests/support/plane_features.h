// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/frame/plane_feature.h"
#include "msc_vo/geometry/plane.h"

namespace msc_vo {

// The exact observation of a plane by most of an image, with sigmas of 4e-3 1/m and without a hull.
inline PlaneFeature FeatureOf(const Plane& in_cam) {
  PlaneFeature feature;
  feature.inverse_depth = -in_cam.normal() / in_cam.offset();
  feature.covariance = 1.6e-5 * Eigen::Matrix3d::Identity();
  feature.mean_square_ray = Eigen::Vector3d(0.1, 0.06, 1.0).asDiagonal();
  return feature;
}

}  // namespace msc_vo
