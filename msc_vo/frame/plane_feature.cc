// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/plane_feature.h"

#include <cmath>

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

void PlaneFeature::Move(const Rigid3& new_from_old) {
  // With a point x, q . x = 1.
  const Eigen::Vector3d turned = new_from_old.rotation() * inverse_depth;
  const double change = turned.dot(new_from_old.translation());
  if (std::abs(change) < 0.5) inverse_depth = turned / (1.0 + change);
}

void PlaneFeature::AddMotionNoise(double rotation_sigma, double translation_sigma) {
  const Eigen::Vector3d normal = Normal();
  const double closeness = inverse_depth.norm();
  const Eigen::Matrix3d along = normal * normal.transpose();
  covariance += std::pow(closeness * rotation_sigma, 2) * (Eigen::Matrix3d::Identity() - along) +
                std::pow(closeness * closeness * translation_sigma, 2) * along;
}

}  // namespace msc_vo
