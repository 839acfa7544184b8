// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/coarse_axes.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "msc_vo/structure/internal/axes_evidence.h"
#include "msc_vo/structure/internal/axes_gates.h"
#include "msc_vo/structure/internal/axes_hypotheses.h"
#include "msc_vo/structure/internal/axes_score.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;

// Selects, among the 24 rotations that differ in order and signs of the axes, the one nearest to
// the identity.
ManhattanAxes InCanonicalOrder(const DirectionEvidence& evidence, const ScoredAxes& scored) {
  std::array<int, 3> order = {0, 1, 2};
  std::array<int, 3> best_order = order;
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
      best_order = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  ManhattanAxes result;
  result.rotation = Eigen::Quaterniond(best).normalized();
  const double num_lines = std::max<double>(1.0, evidence.num_lines);
  const double num_normals = std::max<double>(1.0, evidence.NumNormals());
  for (int i = 0; i < 3; ++i) {
    result.line_ratio[i] = scored.num_lines[best_order[i]] / num_lines;
    result.normal_ratio[i] = scored.num_normals[best_order[i]] / num_normals;
  }
  result.explained_ratio = scored.explained_ratio;
  return result;
}

}  // namespace

bool CoarseAxesOptions::IsValid(std::string* error) const {
  if (!(max_angle > 0.0 && max_angle < 45.0)) {
    *error = "max_angle must lie between 0 and 45 degrees: cones of two axes must not meet";
  } else if (!(max_sigma > 0.0)) {
    *error = "max_sigma must be positive (degrees)";
  } else if (!(last_bandwidth > 0.0 && first_bandwidth >= last_bandwidth &&
               first_bandwidth < 15.0)) {
    *error = "0 < last_bandwidth <= first_bandwidth < 15 degrees must hold";
  } else if (!(min_explained_ratio >= 0.0 && min_explained_ratio <= 1.0)) {
    *error = "min_explained_ratio must lie in [0, 1]";
  } else if (!(max_rival > 0.0 && max_rival <= 1.0)) {
    *error = "max_rival must lie in (0, 1]";
  } else if (!(min_axis_ratio >= 0.0 && min_axis_ratio <= 1.0)) {
    *error = "min_axis_ratio must lie in [0, 1]";
  } else if (!(max_misfit > 0.0)) {
    *error = "max_misfit must be positive (degrees)";
  } else if (!(max_false_alarms > 0.0)) {
    *error = "max_false_alarms must be positive";
  } else {
    return true;
  }
  return false;
}

std::optional<ManhattanAxes> FindCoarseAxes(const CoarseAxesOptions& options,
                                            const std::vector<AxisEvidence>& lines,
                                            const std::vector<AxisEvidence>& normals) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("FindCoarseAxes: " + error);
  const DirectionEvidence evidence = GatherEvidence(options, lines, normals);
  std::vector<ScoredAxes> hypotheses;
  for (const Matrix3d& axes : FindAxesHypotheses(options, evidence)) {
    hypotheses.push_back(ScoreAxes(options, evidence, axes));
  }
  const auto best = std::max_element(
      hypotheses.begin(), hypotheses.end(),
      [](const ScoredAxes& a, const ScoredAxes& b) { return a.density < b.density; });
  if (best == hypotheses.end() || !PassesGates(options, evidence, *best) ||
      HasRival(options, evidence, hypotheses, best->axes)) {
    return std::nullopt;
  }
  return InCanonicalOrder(evidence, *best);
}

}  // namespace msc_vo
