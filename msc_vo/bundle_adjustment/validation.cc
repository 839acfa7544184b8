// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/validation.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/bundle_adjustment/observation.h"

namespace msc_vo {

namespace {

bool IsPositive(double x) { return std::isfinite(x) && x > 0.0; }

// Largest coordinate (pixels, metres or their inverse). Fourth powers of valid coordinates, as in
// the chi-square of a segment's length, do not overflow.
constexpr double kMaxCoordinate = 1e9;

template <typename Vector>
bool AreCoordinates(const Vector& x) {
  return x.allFinite() && x.template lpNorm<Eigen::Infinity>() <= kMaxCoordinate;
}
bool AreCoordinates(double x) { return std::abs(x) <= kMaxCoordinate; }  // false for NaN

// Tolerance of the norm of a unit quaternion or vector: well above accumulated rounding errors.
constexpr double kUnitTolerance = 1e-6;

template <int N>
const char* CovarianceErrorOf(const Eigen::Matrix<double, N, N>& covariance) {
  constexpr const char* kError = "covariance is not positive definite";
  const Eigen::Matrix<double, N, 1> sigma = covariance.diagonal().cwiseSqrt();
  if (!covariance.allFinite() || !(sigma.minCoeff() > 0.0)) return kError;
  // Correlations are dimensionless, so one tolerance fits all entries.
  const Eigen::Matrix<double, N, N> correlation =
      sigma.cwiseInverse().asDiagonal() * covariance * sigma.cwiseInverse().asDiagonal();
  if (!((correlation - correlation.transpose()).cwiseAbs().maxCoeff() < 1e-6)) return kError;
  return correlation.llt().info() == Eigen::Success ? nullptr : kError;
}

}  // namespace

const char* PoseError(const Rigid3& cam_from_world) {
  if (!AreCoordinates(cam_from_world.params)) return "pose is not finite or beyond 1e9 m";
  if (std::abs(cam_from_world.rotation().norm() - 1.0) > kUnitTolerance) {
    return "rotation is not a unit quaternion";
  }
  return nullptr;
}

const char* PositionError(const Eigen::Vector3d& position) {
  return AreCoordinates(position) ? nullptr : "position is not finite or beyond 1e9 m";
}

const char* NoiseError(double noise) {
  return IsPositive(noise) ? nullptr : "noise must be a positive number";
}

const char* DepthOffsetError(double offset) {
  return AreCoordinates(offset) ? nullptr : "depth_offset is not finite or beyond 1e9 m";
}

const char* MapLineError(const LineSegment3& segment) {
  if (!AreCoordinates(segment.start) || !AreCoordinates(segment.end)) {
    return "segment is not finite or beyond 1e9 m";
  }
  if (!(segment.Length() >= kMinLineLength)) return "segment has zero length";
  return nullptr;
}

const char* PointObservationError(const Eigen::Vector2d& pixel, double sigma, double inverse_depth,
                                  double inverse_depth_sigma) {
  if (!AreCoordinates(pixel)) return "pixel is not finite or beyond 1e9";
  if (!IsPositive(sigma)) return "sigma must be positive";
  if (!AreCoordinates(inverse_depth) || inverse_depth < 0.0) {
    return "inverse_depth must be in [0, 1e9]";
  }
  if (inverse_depth > 0.0 && !IsPositive(inverse_depth_sigma)) {
    return "inverse_depth_sigma must be positive";
  }
  return nullptr;
}

const char* LineObservationError(const LineSegment2& segment, double sigma, bool has_depth,
                                 const LineDepth& depth) {
  if (!AreCoordinates(segment.start) || !AreCoordinates(segment.end)) {
    return "segment is not finite or beyond 1e9 pixels";
  }
  if (segment.start == segment.end) return "segment has zero length";
  if (!IsPositive(sigma)) return "sigma must be positive";
  if (!has_depth) return nullptr;
  if (!AreCoordinates(depth.start) || !AreCoordinates(depth.end)) {
    return "depth is not finite or beyond 1e9";
  }
  return CovarianceError(depth.covariance) == nullptr ? nullptr
                                                      : "depth covariance is not positive definite";
}

const char* CovarianceError(const Eigen::Matrix2d& covariance) {
  return CovarianceErrorOf<2>(covariance);
}
const char* CovarianceError(const Eigen::Matrix<double, 6, 6>& covariance) {
  return CovarianceErrorOf<6>(covariance);
}

const char* LinePairError(const WindowData::LinePair& pair) {
  if (pair.a == pair.b) return "pairs a line with itself";
  if (!IsPositive(pair.sigma)) return "sigma must be positive";
  if (pair.count < 1) return "count must be at least 1";
  return nullptr;
}

const char* AxisAlignmentError(const WindowData::AxisAlignment& alignment) {
  if (UnitVectorError(alignment.axis) != nullptr) return "axis is not a unit vector";
  if (!IsPositive(alignment.sigma)) return "sigma must be positive";
  return nullptr;
}

const char* UnitVectorError(const Eigen::Vector3d& v) {
  // False for NaN.
  return std::abs(v.norm() - 1.0) <= kUnitTolerance ? nullptr : "not a unit vector";
}

}  // namespace msc_vo
