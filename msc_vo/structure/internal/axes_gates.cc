// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/internal/axes_gates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "msc_vo/structure/internal/axes_hypotheses.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;

// Windows of adjacent normals overlap: this many normals count as one independent observation.
constexpr double kNormalsPerObservation = 16.0;
// Fewer lines along an axis may be a coincidence.
constexpr double kMinLinesOfAxis = 3.0;
// Smallest fraction of the evidence that the axes explain, of both kinds together and of each kind
// with enough directions. A majority excludes other axes with as much support.
constexpr double kMinExplainedRatio = 0.5;
// Smallest fraction of the normals (lines) in the cone of an axis that has surfaces (lines): ten
// times that of random directions.
constexpr double kMinAxisRatio = 0.05;
// A contrario test: largest expected number of rotations, among those spanned by two of as many
// random directions, with at least as much support.
constexpr double kMaxFalseAlarms = 1e-5;

// Logarithm of the probability of k or more successes in n trials of probability p. Not by
// std::lgamma(), which writes a global variable.
double LogBinomialTail(int n, int k, double p) {
  if (k <= 0) return 0.0;
  double log_choose = 0.0;  // logarithm of n over i
  for (int j = 1; j <= k; ++j) log_choose += std::log(static_cast<double>(n - k + j) / j);
  double tail = 0.0;
  for (int i = k; i <= n; ++i) {
    tail += std::exp(log_choose + i * std::log(p) + (n - i) * std::log1p(-p));
    log_choose += std::log(static_cast<double>(n - i) / (i + 1));
  }
  return tail > 0.0 ? std::log(tail) : -std::numeric_limits<double>::infinity();
}

// A contrario test: the expected number of rotations, among those spanned by two of n random
// directions, that would have as much support. The two that span a rotation are in its cones
// always.
bool IsUnlikelyByChance(const DirectionEvidence& evidence, const ScoredAxes& axes) {
  const double n = evidence.num_lines + evidence.NumNormals() / kNormalsPerObservation;
  const double k = axes.num_lines.sum() + axes.num_normals.sum() / kNormalsPerObservation;
  if (k < 3.0) return false;
  const double chance = 3.0 * (1.0 - std::cos(kAxisCone));
  const double log_tail = LogBinomialTail(static_cast<int>(n) - 2, static_cast<int>(k) - 2, chance);
  return std::log(0.5 * n * (n - 1.0)) + log_tail < std::log(kMaxFalseAlarms);
}

// A kind with few directions is not tested on its own.
bool HasMajority(const DirectionEvidence& evidence, const ScoredAxes& axes) {
  const double min_lines = kMinExplainedRatio * evidence.num_lines;
  const double min_normals = kMinExplainedRatio * evidence.NumNormals();
  return axes.explained_ratio >= kMinExplainedRatio &&
         (evidence.num_lines < kFullWeightLines || axes.num_lines.sum() >= min_lines) &&
         (evidence.NumNormals() < kFullWeightNormals || axes.num_normals.sum() >= min_normals);
}

// Whether the view shows surfaces across two axes or lines along three: a single rectangle has
// lines along two axes and one normal, and may have any orientation.
bool IsVolume(const DirectionEvidence& evidence, const ScoredAxes& axes) {
  const double min_normals = kMinAxisRatio * evidence.NumNormals();
  const double min_lines = std::max(kMinLinesOfAxis, kMinAxisRatio * evidence.num_lines);
  int axes_with_surfaces = 0;
  int axes_with_lines = 0;
  for (int i = 0; i < 3; ++i) {
    if (axes.num_normals[i] > 0.0 && axes.num_normals[i] >= min_normals) {
      ++axes_with_surfaces;
    }
    if (axes.num_lines[i] >= min_lines) ++axes_with_lines;
  }
  return axes_with_surfaces >= 2 || axes_with_lines == 3;
}

// Weight of the evidence that `a` explains and `b` does not.
double ExclusiveWeight(const DirectionEvidence& evidence, const Matrix3d& a, const Matrix3d& b) {
  const double min_cosine = std::cos(kAxisCone);
  double weight = 0.0;
  for (const WeightedDirection& item : evidence.all) {
    const bool in_a = (a.transpose() * item.direction).cwiseAbs().maxCoeff() >= min_cosine;
    const bool in_b = (b.transpose() * item.direction).cwiseAbs().maxCoeff() >= min_cosine;
    if (in_a && !in_b) weight += item.weight;
  }
  return weight;
}

}  // namespace

bool PassesGates(const DirectionEvidence& evidence, const ScoredAxes& axes) {
  return HasMajority(evidence, axes) && axes.misfit.maxCoeff() <= kMaxMisfit &&
         IsVolume(evidence, axes) && IsUnlikelyByChance(evidence, axes);
}

bool HasRival(const DirectionEvidence& evidence, const std::vector<ScoredAxes>& hypotheses,
              const Matrix3d& best) {
  return std::any_of(hypotheses.begin(), hypotheses.end(), [&](const ScoredAxes& other) {
    // Closer hypotheses have overlapping cones: they are the same axes with an error.
    if (AngleBetweenAxes(other.axes, best) < 2.0 * kAxisCone) return false;
    return ExclusiveWeight(evidence, other.axes, best) >
           kMaxRival * ExclusiveWeight(evidence, best, other.axes);
  });
}

}  // namespace msc_vo
