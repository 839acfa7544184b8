// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace msc_vo {

/// A rigid transform. Naming convention: x_in_b = b_from_a * x_in_a.
///
/// The seven parameters are contiguous, quaternion (x, y, z, w) first, then translation (metres):
/// `params.data()` is a parameter block for Rigid3Manifold.
struct Rigid3 {
  Eigen::Matrix<double, 7, 1> params;

  Rigid3();  ///< the identity
  Rigid3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation);

  Eigen::Map<Eigen::Quaterniond> rotation() {
    return Eigen::Map<Eigen::Quaterniond>(params.data());
  }
  Eigen::Map<const Eigen::Quaterniond> rotation() const {
    return Eigen::Map<const Eigen::Quaterniond>(params.data());
  }
  Eigen::Map<Eigen::Vector3d> translation() { return Eigen::Map<Eigen::Vector3d>(&params[4]); }
  Eigen::Map<const Eigen::Vector3d> translation() const {
    return Eigen::Map<const Eigen::Vector3d>(&params[4]);
  }

  Rigid3 Inverse() const;

  /// Origin of the target frame in the source frame: of cam_from_world, the camera centre in world.
  Eigen::Vector3d OriginInSource() const;

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation() * x + translation();
  }
  Rigid3 operator*(const Rigid3& b_from_a) const;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, params);
  }
};

}  // namespace msc_vo
