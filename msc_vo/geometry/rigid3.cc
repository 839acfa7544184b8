// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

Rigid3::Rigid3() { params << 0, 0, 0, 1, 0, 0, 0; }

Rigid3::Rigid3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
  params << rotation.coeffs(), translation;
}

Rigid3 Rigid3::Inverse() const {
  const Eigen::Quaterniond inverse = rotation().conjugate();
  return {inverse, -(inverse * translation())};
}

Eigen::Vector3d Rigid3::OriginInSource() const { return -(rotation().conjugate() * translation()); }

Rigid3 Rigid3::operator*(const Rigid3& b_from_a) const {
  return {(rotation() * b_from_a.rotation()).normalized(),
          rotation() * b_from_a.translation() + translation()};
}

}  // namespace msc_vo
