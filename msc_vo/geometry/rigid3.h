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
  Eigen::Matrix<double, 7, 1> params =
      (Eigen::Matrix<double, 7, 1>() << 0, 0, 0, 1, 0, 0, 0).finished();

  Rigid3() = default;
  Rigid3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
    params << rotation.coeffs(), translation;
  }

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

  Rigid3 Inverse() const {
    const Eigen::Quaterniond inverse = rotation().conjugate();
    return {inverse, -(inverse * translation())};
  }

  /// Origin of the target frame in the source frame: of cam_from_world, the camera centre in world.
  Eigen::Vector3d OriginInSource() const { return -(rotation().conjugate() * translation()); }

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const {
    return rotation() * x + translation();
  }
  Rigid3 operator*(const Rigid3& b_from_a) const {
    return {(rotation() * b_from_a.rotation()).normalized(),
            rotation() * b_from_a.translation() + translation()};
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, params);
  }
};

}  // namespace msc_vo
