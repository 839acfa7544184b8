// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_score.h"

#include <cmath>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ScoredAxes ScoreAxes(const DirectionEvidence& evidence, const Matrix3d& axes) {
  ScoredAxes scored;
  scored.axes = axes;
  const double min_cosine = std::cos(kAxisCone);
  constexpr double kScale = -0.5 / (kLastBandwidth * kLastBandwidth);
  Matrix3d sum = Matrix3d::Zero();
  for (size_t i = 0; i < evidence.all.size(); ++i) {
    const WeightedDirection& item = evidence.all[i];
    int axis = 0;
    const Vector3d cosines = axes.transpose() * item.direction;
    if (cosines.cwiseAbs().maxCoeff(&axis) < min_cosine) continue;
    (evidence.IsLine(i) ? scored.num_lines : scored.num_normals)[axis] += 1.0;
    scored.explained_ratio += item.weight;
    const Vector3d in_plane = item.direction / cosines[axis] - axes.col(axis);
    scored.density += item.weight * std::exp(kScale * in_plane.squaredNorm());
    sum.col(axis) += std::copysign(item.weight, cosines[axis]) * item.direction;
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3d mean = sum.col(i);
    if (mean.norm() > 0.0) scored.misfit[i] = UndirectedAngle(mean, Vector3d(axes.col(i)));
  }
  return scored;
}

}  // namespace msc_vo
