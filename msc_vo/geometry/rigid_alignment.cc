// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/rigid_alignment.h"

#include <stdexcept>

#include <Eigen/SVD>

namespace msc_vo {

Rigid3 AlignRigid(const std::vector<Eigen::Vector3d>& source,
                  const std::vector<Eigen::Vector3d>& target) {
  if (source.size() != target.size()) {
    throw std::invalid_argument("AlignRigid: source and target differ in size");
  }
  if (source.size() < 3) throw std::invalid_argument("AlignRigid: fewer than three pairs");

  const double count = static_cast<double>(source.size());
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < source.size(); ++i) {
    source_mean += source[i] / count;
    target_mean += target[i] / count;
  }
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < source.size(); ++i) {
    correlation += (target[i] - target_mean) * (source[i] - source_mean).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The last singular vector is flipped where the best orthogonal matrix would be a mirror image.
  Eigen::Vector3d sign(1.0, 1.0, 1.0);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  return {Eigen::Quaterniond(rotation), target_mean - rotation * source_mean};
}

}  // namespace msc_vo
