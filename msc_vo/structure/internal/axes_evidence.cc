// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_evidence.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

using Eigen::Vector3d;

std::vector<Vector3d> UsableDirections(const std::vector<AxisEvidence>& evidence) {
  std::vector<Vector3d> directions;
  for (const AxisEvidence& item : evidence) {
    if (item.sigma <= kMaxEvidenceSigma) directions.push_back(item.direction.normalized());
  }
  // Sorted, so that sums and ties do not depend on the order of the input.
  std::sort(directions.begin(), directions.end(), [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return directions;
}

}  // namespace

DirectionEvidence GatherEvidence(const std::vector<AxisEvidence>& lines,
                                 const std::vector<AxisEvidence>& normals) {
  const std::vector<Vector3d> line_directions = UsableDirections(lines);
  const std::vector<Vector3d> normal_directions = UsableDirections(normals);
  const double line_total = std::min(1.0, line_directions.size() / kFullWeightLines);
  const double normal_total = std::min(1.0, normal_directions.size() / kFullWeightNormals);
  const double total = line_total + normal_total;
  DirectionEvidence evidence;
  evidence.num_lines = line_directions.size();
  for (const Vector3d& direction : line_directions) {
    evidence.all.push_back({direction, line_total / total / line_directions.size()});
  }
  for (const Vector3d& direction : normal_directions) {
    evidence.all.push_back({direction, normal_total / total / normal_directions.size()});
  }
  return evidence;
}

ScoredAxes ScoreAxes(const DirectionEvidence& evidence, const Eigen::Matrix3d& axes) {
  ScoredAxes scored;
  scored.axes = axes;
  const double min_cosine = std::cos(kAxisCone);
  constexpr double kScale = -0.5 / (kLastBandwidth * kLastBandwidth);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
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
