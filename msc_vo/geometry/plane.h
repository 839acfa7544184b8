// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// The plane n . x + d = 0.
struct Plane {
  /// n, a unit vector towards the side that is seen, then d, metres: the distance of the origin
  /// from the plane, positive on that side.
  Eigen::Vector4d params = Eigen::Vector4d::Zero();

  Plane() = default;
  Plane(const Eigen::Vector3d& normal, double offset) { params << normal, offset; }

  Eigen::Vector3d normal() const { return params.head<3>(); }
  double offset() const { return params[3]; }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, params);
  }
};

/// The plane in the target frame of the transformation.
inline Plane operator*(const Rigid3& target_from_source, const Plane& plane) {
  const Eigen::Vector3d normal = target_from_source.rotation() * plane.normal();
  return {normal, plane.offset() - normal.dot(target_from_source.translation())};
}

}  // namespace msc_vo
