// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/plane_feature.h"

namespace msc_vo {

PlaneExtent PlaneFeature::Extent() const {
  PlaneExtent extent;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d a = hull[i].homogeneous();
    const Eigen::Vector3d b = hull[(i + 1) % hull.size()].homogeneous();
    const double excess_a = inverse_depth.dot(a) - kMinInverseDepth;
    const double excess_b = inverse_depth.dot(b) - kMinInverseDepth;
    if (excess_a >= 0.0) extent.push_back(a / inverse_depth.dot(a));
    if (excess_a * excess_b < 0.0) {
      const Eigen::Vector3d crossing = a + excess_a / (excess_a - excess_b) * (b - a);
      extent.push_back(crossing / kMinInverseDepth);
    }
  }
  if (extent.size() < 3) extent.clear();  // only a corner or an edge is not too far
  return extent;
}

}  // namespace msc_vo
