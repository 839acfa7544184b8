// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/structure/axis_evidence.h"
#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo::testing {

using Evidence = std::vector<AxisEvidence>;

// Uniformly distributed on the sphere.
inline Eigen::Vector3d RandomDirection(Random* random) { return random->Normal3().normalized(); }

inline Eigen::Quaterniond RandomRotation(Random* random) {
  const Eigen::Vector2d a = random->Normal2();
  const Eigen::Vector2d b = random->Normal2();
  return Eigen::Quaterniond(a.x(), a.y(), b.x(), b.y()).normalized();
}

// Adds `count` copies of a direction with angular noise `sigma` (radians, per component) and random
// signs.
inline void AddAlong(const Eigen::Vector3d& direction, int count, double sigma, Random* random,
                     Evidence* evidence) {
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d noisy = ExpSO3(sigma * random->Normal3()) * direction;
    evidence->push_back({random->Uniform() < 0.5 ? noisy : Eigen::Vector3d(-noisy), sigma});
  }
}

// Adds random directions.
inline void AddClutter(int count, double sigma, Random* random, Evidence* evidence) {
  for (int i = 0; i < count; ++i) evidence->push_back({RandomDirection(random), sigma});
}

// Lines and normals of one view, with the sigmas of a noisy depth sensor.
struct View {
  Evidence lines;
  Evidence normals;
};
constexpr double kLineSigma = DegreesToRadians(1.0);
constexpr double kNormalSigma = DegreesToRadians(2.0);

inline void AddLines(const Eigen::Vector3d& direction, int count, Random* random, View* view) {
  AddAlong(direction, count, kLineSigma, random, &view->lines);
}
inline void AddNormals(const Eigen::Vector3d& direction, int count, Random* random, View* view) {
  AddAlong(direction, count, kNormalSigma, random, &view->normals);
}

// 80 lines and 800 normals along the axes of a room, with the fraction `clutter` in random
// directions.
inline View RoomView(const Eigen::Quaterniond& rotation, double clutter, Random* random) {
  const Eigen::Matrix3d axes = rotation.toRotationMatrix();
  const double kept = 1.0 - clutter;
  View view;
  AddLines(axes.col(0), static_cast<int>(40 * kept), random, &view);
  AddLines(axes.col(1), static_cast<int>(30 * kept), random, &view);
  AddLines(axes.col(2), static_cast<int>(10 * kept), random, &view);
  AddNormals(axes.col(0), static_cast<int>(150 * kept), random, &view);
  AddNormals(axes.col(1), static_cast<int>(250 * kept), random, &view);
  AddNormals(axes.col(2), static_cast<int>(400 * kept), random, &view);
  AddClutter(80 - static_cast<int>(view.lines.size()), kLineSigma, random, &view.lines);
  AddClutter(800 - static_cast<int>(view.normals.size()), kNormalSigma, random, &view.normals);
  return view;
}

// Largest angle, degrees, between an axis of `a` and the axis of `b` nearest to it.
inline double AxesErrorInDegrees(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Matrix3d c = (a.conjugate() * b).toRotationMatrix().cwiseAbs();
  return RadiansToDegrees(std::acos(std::min(1.0, c.rowwise().maxCoeff().minCoeff())));
}

}  // namespace msc_vo::testing
