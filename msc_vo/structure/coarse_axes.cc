// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/coarse_axes.h"

#include <algorithm>
#include <array>

#include "msc_vo/structure/internal/axes_evidence.h"
#include "msc_vo/structure/internal/axes_gates.h"
#include "msc_vo/structure/internal/axes_hypotheses.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;

// Selects, among the 24 rotations that differ in order and signs of the axes, the one nearest to
// the identity.
ManhattanAxes InCanonicalOrder(const ScoredAxes& scored) {
  std::array<int, 3> order = {0, 1, 2};
  Matrix3d best = Matrix3d::Zero();
  double best_trace = -4.0;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d axes;
      for (int i = 0; i < 3; ++i) {
        axes.col(i) = (signs >> i & 1 ? -1.0 : 1.0) * scored.axes.col(order[i]);
      }
      if (axes.determinant() < 0.0 || axes.trace() <= best_trace) continue;
      best = axes;
      best_trace = axes.trace();
    }
  } while (std::next_permutation(order.begin(), order.end()));
  ManhattanAxes result;
  result.rotation = Eigen::Quaterniond(best).normalized();
  result.explained_ratio = scored.explained_ratio;
  return result;
}

}  // namespace

std::optional<ManhattanAxes> FindCoarseAxes(const std::vector<AxisEvidence>& lines,
                                            const std::vector<AxisEvidence>& normals) {
  const DirectionEvidence evidence = GatherEvidence(lines, normals);
  std::vector<ScoredAxes> hypotheses;
  for (const Matrix3d& axes : FindAxesHypotheses(evidence)) {
    hypotheses.push_back(ScoreAxes(evidence, axes));
  }
  const auto best = std::max_element(
      hypotheses.begin(), hypotheses.end(),
      [](const ScoredAxes& a, const ScoredAxes& b) { return a.density < b.density; });
  if (best == hypotheses.end() || !PassesGates(evidence, *best) ||
      HasRival(evidence, hypotheses, best->axes)) {
    return std::nullopt;
  }
  return InCanonicalOrder(*best);
}

}  // namespace msc_vo
