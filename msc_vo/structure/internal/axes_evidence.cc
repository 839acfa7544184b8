// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_evidence.h"

#include <algorithm>

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

}  // namespace msc_vo
