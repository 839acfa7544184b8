// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/geometry/line_alignment.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// Smallest angle between two lines. An error of a direction out of the plane of both turns the
// result by up to its product with the cosecant of that angle: three times the error at 20 degrees.
constexpr double kMinAngle = DegreesToRadians(20.0);

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// Signed distance of the second line from the first along the normal of both.
double Distance(const LineSegment3& a, const LineSegment3& b) {
  return (b.Midpoint() - a.Midpoint()).dot(a.Direction().cross(b.Direction()).normalized());
}

// Right-handed frame whose first two axes are the bisectors of two directions.
Eigen::Matrix3d BisectorFrame(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d axes;
  axes.col(0) = (a + b).normalized();
  axes.col(1) = (a - b).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

// Projector onto the plane across the line: a line does not determine a position along itself.
Eigen::Matrix3d Across(const LineSegment3& line) {
  const Eigen::Vector3d direction = line.Direction();
  return Eigen::Matrix3d::Identity() - direction * direction.transpose();
}

Rigid3 Transform(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return {Eigen::Quaterniond(rotation).normalized(), translation};
}

}  // namespace

std::optional<Rigid3> AlignLines(const std::array<LineSegment3, 2>& source,
                                 const std::array<LineSegment3, 2>& target,
                                 const AlignmentTolerance& tolerance) {
  const Eigen::Vector3d s0 = source[0].Direction(), s1 = source[1].Direction();
  const Eigen::Vector3d t0 = target[0].Direction(), t1 = target[1].Direction();
  if (!(UndirectedAngle(s0, s1) >= kMinAngle) || !(UndirectedAngle(t0, t1) >= kMinAngle) ||
      !(std::abs(Angle(s0, s1) - Angle(t0, t1)) <= tolerance.angle) ||
      !(std::abs(Distance(source[0], source[1]) - Distance(target[0], target[1])) <=
        tolerance.distance)) {
    return std::nullopt;
  }
  const Eigen::Matrix3d rotation = BisectorFrame(t0, t1) * BisectorFrame(s0, s1).transpose();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 2; ++i) {
    const Eigen::Matrix3d across = Across(target[i]);
    information += across;
    sum += across * (target[i].Midpoint() - rotation * source[i].Midpoint());
  }
  return Transform(rotation, information.ldlt().solve(sum));
}

std::optional<Rigid3> AlignLineAndPoint(const LineSegment3& source_line,
                                        const Eigen::Vector3d& source_point,
                                        const LineSegment3& target_line,
                                        const Eigen::Vector3d& target_point,
                                        const AlignmentTolerance& tolerance) {
  const Eigen::Vector3d s = Across(source_line) * (source_point - source_line.Midpoint());
  const Eigen::Vector3d t = Across(target_line) * (target_point - target_line.Midpoint());
  const double shortest = std::min(s.norm(), t.norm());
  if (!(shortest > 10.0 * tolerance.distance) ||
      !(std::abs(s.norm() - t.norm()) <= tolerance.distance)) {
    return std::nullopt;
  }
  const Eigen::Matrix3d rotation =
      BisectorFrame(target_line.Direction(), t.normalized()) *
      BisectorFrame(source_line.Direction(), s.normalized()).transpose();
  const Eigen::Matrix3d across = Across(target_line);
  const Eigen::Matrix3d information = across + Eigen::Matrix3d::Identity();
  const Eigen::Vector3d sum =
      across * (target_line.Midpoint() - rotation * source_line.Midpoint()) + target_point -
      rotation * source_point;
  return Transform(rotation, information.ldlt().solve(sum));
}

}  // namespace msc_vo
