// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "tests/support/factor_checks.h"
#include <Eigen/LU>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/frame_structure.h"

namespace msc_vo {

// One frame of a room for the tests of structure: lines along three orthogonal axes with a random
// orientation, other lines in random directions, and line depths with the noise of a sensor.
struct StructureFrameOptions {
  int num_lines = 60;
  double free_ratio = 0.2;              // fraction of lines in random directions
  double deviation = 0.35;              // degrees, of a line from its axis, per component
  double inverse_depth_sigma = 1.4e-3;  // 1/metres, of a sample; one every four pixels
  double image_sigma = 1.0;             // pixels, of an end point across its segment
  double fy = 525.0;                    // may be negative
  unsigned seed = 1;
};

struct StructureFrame {
  PinholeCamera camera;
  std::vector<StructureLine> lines;
  std::vector<LineSegment3> truth;  // metres, camera
  std::vector<bool> free;           // not along an axis

  Eigen::Vector2d TrueDepths(size_t i) const {
    return {1.0 / truth[i].start.z(), 1.0 / truth[i].end.z()};
  }
  // Squared error (radians^2) of the direction of line i with the depths of `line`. Uses the true
  // image segment, whose noise depth cannot reduce.
  double SquaredDirectionError(size_t i, const StructureLine& line) const {
    const LineSegment2 image{camera.Project(truth[i].start), camera.Project(truth[i].end)};
    const Eigen::Vector3d d = BackProject(camera, image, line.depth).Direction();
    return d.cross(truth[i].Direction()).squaredNorm();
  }
  // Normalised squared error of the depths of line i: chi-square with two degrees of freedom.
  double SquaredNormalizedError(size_t i, const StructureLine& line) const {
    const Eigen::Vector2d error = Eigen::Vector2d(line.depth.start, line.depth.end) - TrueDepths(i);
    return error.dot(line.depth.covariance.inverse() * error);
  }
};

inline StructureFrame MakeStructureFrame(const StructureFrameOptions& options) {
  StructureFrame frame;
  frame.camera.fy = options.fy;
  RandomGeometry random(options.seed);
  const Eigen::Quaterniond axes = random.Pose().rotation();
  while (static_cast<int>(frame.lines.size()) < options.num_lines) {
    const double z = random.Uniform(1.2, 4.5);
    const double x = random.Uniform(-0.55, 0.55), y = random.Uniform(-0.4, 0.4);
    const bool is_free = random.Uniform(0.0, 1.0) < options.free_ratio;
    Eigen::Vector3d d = random.Normal3().normalized();
    if (!is_free) {
      const Eigen::Vector3d turn = options.deviation * kPi / 180.0 * random.Normal3();
      const int axis = static_cast<int>(random.Uniform(0.0, 3.0));
      d = (random.Normal() < 0.0 ? -1.0 : 1.0) *
          (ExpSO3(turn) * axes * Eigen::Vector3d::Unit(axis));
    }
    LineSegment3 truth;
    truth.start = Eigen::Vector3d(z * x, z * y, z);
    truth.end = truth.start + random.Uniform(0.3, 1.5) * d;
    if (truth.end.z() < 0.5 || truth.end.z() > 6.0) continue;
    StructureLine line;
    line.segment = {frame.camera.Project(truth.start), frame.camera.Project(truth.end)};
    const double length = line.segment.Length();
    if (!frame.camera.IsInside(line.segment.start) || !frame.camera.IsInside(line.segment.end) ||
        length < 40.0) {
      continue;
    }
    const int count = static_cast<int>(length / 4.0);
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    for (int i = 0; i < count; ++i) {
      const double s = (i + 0.5) / count;
      const Eigen::Vector2d a = Eigen::Vector2d(1.0 - s, s) / options.inverse_depth_sigma;
      information += a * a.transpose();
    }
    line.depth.covariance = information.inverse();
    const Eigen::Vector2d noise =
        Eigen::Matrix2d(line.depth.covariance.llt().matrixL()) * random.Normal2();
    line.depth.start = 1.0 / truth.start.z() + noise.x();
    line.depth.end = 1.0 / truth.end.z() + noise.y();
    const Eigen::Vector2d along = line.segment.Direction();
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d shift = options.image_sigma * random.Normal2();
    line.segment.start += shift.x() * across;
    line.segment.end += shift.y() * across;
    line.sigma = options.image_sigma;
    frame.lines.push_back(line);
    frame.truth.push_back(truth);
    frame.free.push_back(is_free);
  }
  return frame;
}

}  // namespace msc_vo
