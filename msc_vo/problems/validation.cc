// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/validation.h"

#include <cmath>

namespace msc_vo {

namespace {

bool IsPositive(double x) { return std::isfinite(x) && x > 0.0; }

// Of the norm of a unit quaternion or vector: far above the rounding of any product of rotations,
// far below a wrong one.
constexpr double kUnitTolerance = 1e-6;

}  // namespace

const char* PoseError(const Rigid3& cam_from_world) {
  if (!cam_from_world.params.allFinite()) return "pose is not finite";
  if (std::abs(cam_from_world.rotation().norm() - 1.0) > kUnitTolerance) {
    return "rotation is not unit";
  }
  return nullptr;
}

const char* PositionError(const Eigen::Vector3d& position) {
  return position.allFinite() ? nullptr : "position is not finite";
}

const char* MapLineError(const LineSegment3& segment) {
  if (!segment.start.allFinite() || !segment.end.allFinite()) return "segment is not finite";
  if (segment.start == segment.end) return "segment has no length";
  return nullptr;
}

const char* PointObservationError(const Eigen::Vector2d& pixel, double sigma, double inverse_depth,
                                  double inverse_depth_sigma) {
  if (!pixel.allFinite()) return "pixel is not finite";
  if (!IsPositive(sigma)) return "sigma must be positive";
  if (!std::isfinite(inverse_depth) || inverse_depth < 0.0) {
    return "inverse_depth must not be negative";
  }
  if (inverse_depth > 0.0 && !IsPositive(inverse_depth_sigma)) {
    return "inverse_depth_sigma must be positive";
  }
  return nullptr;
}

const char* LineObservationError(const LineSegment2& segment, double sigma, bool has_depth,
                                 const LineDepth& depth) {
  if (!segment.start.allFinite() || !segment.end.allFinite()) return "segment is not finite";
  if (segment.start == segment.end) return "segment has no length";
  if (!IsPositive(sigma)) return "sigma must be positive";
  if (!has_depth) return nullptr;
  if (!std::isfinite(depth.start) || !std::isfinite(depth.end)) return "depth is not finite";
  // SigmaAt must be positive at every parameter.
  if (!depth.covariance.allFinite() || !IsPositive(depth.covariance(0, 0)) ||
      !IsPositive(depth.covariance.determinant())) {
    return "depth covariance is not positive definite";
  }
  return nullptr;
}

const char* LinePairError(const WindowData::LinePair& pair) {
  if (pair.a == pair.b) return "a line with itself";
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
  // As for rotations; NaN fails too.
  return std::abs(v.norm() - 1.0) <= kUnitTolerance ? nullptr : "vector is not unit";
}

}  // namespace msc_vo
