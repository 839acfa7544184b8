// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/rigid_alignment.h"

#include <stdexcept>

#include <Eigen/SVD>

namespace msc_vo {

namespace {

// Rotation closest to a matrix in the Frobenius norm.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // The last singular vector is negated if the closest orthogonal matrix is a reflection.
  Eigen::Vector3d sign(1.0, 1.0, 1.0);
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

// Means of both point sets and sum of (target - mean) (source - mean)^T.
struct PointMoments {
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
};

PointMoments ComputeMoments(const std::vector<Eigen::Vector3d>& source,
                            const std::vector<Eigen::Vector3d>& target) {
  if (source.size() != target.size()) {
    throw std::invalid_argument("AlignRigid: source and target differ in size");
  }
  if (source.size() < 3) throw std::invalid_argument("AlignRigid: fewer than three pairs");

  PointMoments moments;
  const double count = static_cast<double>(source.size());
  for (size_t i = 0; i < source.size(); ++i) {
    moments.source_mean += source[i] / count;
    moments.target_mean += target[i] / count;
  }
  for (size_t i = 0; i < source.size(); ++i) {
    moments.correlation +=
        (target[i] - moments.target_mean) * (source[i] - moments.source_mean).transpose();
  }
  return moments;
}

}  // namespace

Rigid3 AlignRigid(const std::vector<Eigen::Vector3d>& source,
                  const std::vector<Eigen::Vector3d>& target) {
  const PointMoments moments = ComputeMoments(source, target);
  const Eigen::Matrix3d rotation = NearestRotation(moments.correlation);
  return {Eigen::Quaterniond(rotation), moments.target_mean - rotation * moments.source_mean};
}

double AlignmentScale(const std::vector<Eigen::Vector3d>& source,
                      const std::vector<Eigen::Vector3d>& target) {
  const PointMoments moments = ComputeMoments(source, target);
  double source_squares = 0.0;
  for (const Eigen::Vector3d& x : source) source_squares += (x - moments.source_mean).squaredNorm();
  if (!(source_squares > 0.0)) {
    throw std::invalid_argument("AlignmentScale: the source points coincide");
  }
  const Eigen::Matrix3d rotation = NearestRotation(moments.correlation);
  return (rotation.transpose() * moments.correlation).trace() / source_squares;
}

Rigid3 AlignPoses(const std::vector<Rigid3>& source, const std::vector<Rigid3>& target) {
  if (source.size() != target.size()) {
    throw std::invalid_argument("AlignPoses: source and target differ in size");
  }
  if (source.empty()) throw std::invalid_argument("AlignPoses: no pair");

  const double count = static_cast<double>(source.size());
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d source_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_mean = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < source.size(); ++i) {
    sum += (target[i].rotation() * source[i].rotation().conjugate()).toRotationMatrix();
    source_mean += source[i].translation() / count;
    target_mean += target[i].translation() / count;
  }
  const Eigen::Matrix3d rotation = NearestRotation(sum);
  return {Eigen::Quaterniond(rotation), target_mean - rotation * source_mean};
}

}  // namespace msc_vo
