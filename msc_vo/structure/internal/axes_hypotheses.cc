// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_hypotheses.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Modes of the evidence and their smallest distance, which is less than that of two axes and more
// than the spread of one.
constexpr int kMaxModes = 12;
constexpr double kModeBandwidth = DegreesToRadians(3.0);
constexpr double kModeSeparation = DegreesToRadians(10.0);
// Two modes span a rotation if they are perpendicular up to the error of two modes.
constexpr double kPerpendicularTolerance = DegreesToRadians(10.0);
// Rotations closer to each other than this converge to the same axes.
constexpr double kSameAxes = DegreesToRadians(5.0);
constexpr int kMaxShifts = 15;
constexpr double kConverged = DegreesToRadians(0.01);
constexpr double kBandwidthDecay = 0.7;  // factor of the bandwidth per step
constexpr double kReach = 3.0;           // bandwidths, where the kernel is truncated

Matrix3d NearestRotation(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

// One step of mean shift: the evidence in the cone around each axis is projected centrally onto the
// tangent plane of the axis and moves the axis by its mean under the kernel. The three axes are
// then made orthogonal again, weighted by their evidence.
Matrix3d ShiftAxes(const DirectionEvidence& evidence, const Matrix3d& axes, double bandwidth) {
  const double min_cosine = std::cos(kReach * bandwidth);
  const double scale = -0.5 / (bandwidth * bandwidth);
  Vector3d mass = Vector3d::Zero();
  Matrix3d moment = Matrix3d::Zero();
  for (const WeightedDirection& item : evidence.all) {
    int axis = 0;
    const Vector3d cosines = axes.transpose() * item.direction;
    if (cosines.cwiseAbs().maxCoeff(&axis) < min_cosine) continue;
    const Vector3d in_plane = item.direction / cosines[axis] - axes.col(axis);
    const double weight = item.weight * std::exp(scale * in_plane.squaredNorm());
    mass[axis] += weight;
    moment.col(axis) += weight * in_plane;
  }
  // Small weight of an axis without evidence, which then follows the others.
  constexpr double kNoEvidence = 1e-9;
  Matrix3d shifted = kNoEvidence * axes;
  for (int i = 0; i < 3; ++i) {
    if (mass[i] > 0.0) {
      shifted.col(i) += mass[i] * (axes.col(i) + moment.col(i) / mass[i]).normalized();
    }
  }
  return NearestRotation(shifted);
}

Matrix3d RefineByMeanShift(const DirectionEvidence& evidence, Matrix3d axes) {
  double bandwidth = kFirstBandwidth;
  while (bandwidth > kLastBandwidth) {
    axes = ShiftAxes(evidence, axes, bandwidth);
    bandwidth *= kBandwidthDecay;
  }
  for (int i = 0; i < kMaxShifts; ++i) {
    const Matrix3d before = axes;
    axes = ShiftAxes(evidence, axes, kLastBandwidth);
    if (AngleBetweenAxes(before, axes) < kConverged) break;
  }
  return axes;
}

std::vector<Matrix3d> SpanRotations(const DirectionEvidence& evidence) {
  const std::vector<Vector3d> modes =
      FindDirectionModes(evidence.all, kModeBandwidth, kModeSeparation, kMaxModes);
  std::vector<Matrix3d> rotations;
  for (size_t i = 0; i < modes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (std::abs(modes[i].dot(modes[j])) > std::sin(kPerpendicularTolerance)) continue;
      Matrix3d axes;
      axes << modes[j], modes[i], modes[j].cross(modes[i]);
      axes = NearestRotation(axes);
      const bool is_new = std::none_of(
          rotations.begin(), rotations.end(),
          [&](const Matrix3d& other) { return AngleBetweenAxes(other, axes) < kSameAxes; });
      if (is_new) rotations.push_back(axes);
    }
  }
  return rotations;
}

}  // namespace

double AngleBetweenAxes(const Matrix3d& a, const Matrix3d& b) {
  const Vector3d nearest = (a.transpose() * b).cwiseAbs().rowwise().maxCoeff();
  return std::acos(std::min(1.0, nearest.minCoeff()));
}

std::vector<Matrix3d> FindAxesHypotheses(const DirectionEvidence& evidence) {
  std::vector<Matrix3d> hypotheses;
  for (const Matrix3d& axes : SpanRotations(evidence)) {
    hypotheses.push_back(RefineByMeanShift(evidence, axes));
  }
  return hypotheses;
}

}  // namespace msc_vo
