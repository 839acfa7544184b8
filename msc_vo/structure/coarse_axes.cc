// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/coarse_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/SVD>

#include "msc_vo/structure/direction_modes.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Modes of the evidence, and how far they lie apart: less than two axes, more than one smears.
constexpr int kMaxModes = 12;
constexpr double kModeBandwidth = DegreesToRadians(3.0);
constexpr double kModeSeparation = DegreesToRadians(10.0);
// Two modes span a candidate if they are perpendicular up to the error of two modes.
constexpr double kPerpendicularTolerance = DegreesToRadians(10.0);
// Candidates nearer to each other climb to the same axes.
constexpr double kSameAxes = DegreesToRadians(5.0);
// From so many members on a kind counts fully: the share of 20 is known to 0.1.
constexpr double kFullLines = 20.0;
constexpr double kFullNormals = 200.0;
// Windows of neighbouring normals overlap: so many of them are one observation.
constexpr double kNormalsPerObservation = 16.0;
// Lines of an axis below this number may be a chance.
constexpr double kMinLinesOfAxis = 3.0;
constexpr int kMaxShifts = 15;
constexpr double kConverged = DegreesToRadians(0.01);
constexpr double kCoolDown = 0.7;  // of the bandwidth, from step to step
constexpr double kReach = 3.0;     // bandwidths, where the kernel is cut off

struct Evidence {
  std::vector<WeightedDirection> all;  // lines first; weights sum to 1
  size_t num_lines = 0;

  size_t NumNormals() const { return all.size() - num_lines; }
  bool IsLine(size_t i) const { return i < num_lines; }
};

std::vector<Vector3d> UsableDirections(const std::vector<AxisEvidence>& evidence,
                                       double max_sigma) {
  std::vector<Vector3d> directions;
  for (const AxisEvidence& item : evidence) {
    if (item.sigma <= max_sigma) directions.push_back(item.direction.normalized());
  }
  // In an order of their own, so that sums and ties do not depend on the order of the input.
  std::sort(directions.begin(), directions.end(), [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return directions;
}

Evidence Gather(const CoarseAxesOptions& options, const std::vector<AxisEvidence>& lines,
                const std::vector<AxisEvidence>& normals) {
  const std::vector<Vector3d> line_directions = UsableDirections(lines, options.max_sigma);
  const std::vector<Vector3d> normal_directions = UsableDirections(normals, options.max_sigma);
  const double line_total = std::min(1.0, line_directions.size() / kFullLines);
  const double normal_total = std::min(1.0, normal_directions.size() / kFullNormals);
  const double total = line_total + normal_total;
  Evidence evidence;
  evidence.num_lines = line_directions.size();
  for (const Vector3d& direction : line_directions) {
    evidence.all.push_back({direction, line_total / total / line_directions.size()});
  }
  for (const Vector3d& direction : normal_directions) {
    evidence.all.push_back({direction, normal_total / total / normal_directions.size()});
  }
  return evidence;
}

Matrix3d NearestRotation(const Matrix3d& m) {
  const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) = -u.col(2);
  return u * svd.matrixV().transpose();
}

// Angle by which the axes of `a` must turn at most to become those of `b`, in any order.
double AngleBetweenAxes(const Matrix3d& a, const Matrix3d& b) {
  const Vector3d nearest = (a.transpose() * b).cwiseAbs().rowwise().maxCoeff();
  return std::acos(std::min(1.0, nearest.minCoeff()));
}

// One step of mean shift: evidence in the cone around each axis, projected centrally onto the
// tangent plane there, moves the axis by its mean under the kernel; then the three axes become
// orthogonal again, each as stiff as its evidence is heavy.
Matrix3d ShiftAxes(const Evidence& evidence, const Matrix3d& axes, double bandwidth) {
  const double min_cosine = std::cos(kReach * bandwidth);
  const double scale = -0.5 / (bandwidth * bandwidth);
  Vector3d mass = Vector3d::Zero();
  Matrix3d moment = Matrix3d::Zero();
  for (const WeightedDirection& item : evidence.all) {
    int axis = 0;
    const Vector3d cosines = axes.transpose() * item.direction;
    if (cosines.cwiseAbs().maxCoeff(&axis) < min_cosine) continue;
    const Vector3d in_plane = item.direction / cosines[axis] - axes.col(axis);
    const double weight = item.weight * std::exp(scale * in_plane.squaredNorm());
    mass[axis] += weight;
    moment.col(axis) += weight * in_plane;
  }
  // An axis without evidence follows the others.
  constexpr double kNoEvidence = 1e-9;
  Matrix3d shifted = kNoEvidence * axes;
  for (int i = 0; i < 3; ++i) {
    if (mass[i] > 0.0) {
      shifted.col(i) += mass[i] * (axes.col(i) + moment.col(i) / mass[i]).normalized();
    }
  }
  return NearestRotation(shifted);
}

Matrix3d Climb(const CoarseAxesOptions& options, const Evidence& evidence, Matrix3d axes) {
  for (double h = options.first_bandwidth; h > options.last_bandwidth; h *= kCoolDown) {
    axes = ShiftAxes(evidence, axes, h);
  }
  for (int i = 0; i < kMaxShifts; ++i) {
    const Matrix3d before = axes;
    axes = ShiftAxes(evidence, axes, options.last_bandwidth);
    if (AngleBetweenAxes(before, axes) < kConverged) break;
  }
  return axes;
}

struct Candidate {
  Matrix3d axes = Matrix3d::Identity();
  Vector3d num_lines = Vector3d::Zero();  // in the cone of each axis
  Vector3d num_normals = Vector3d::Zero();
  Vector3d misfit = Vector3d::Zero();  // radians, mean of the cone to its axis
  double share = 0.0;
  double density = 0.0;  // what mean shift climbs: weights under the last kernel
};

Candidate Measure(const CoarseAxesOptions& options, const Evidence& evidence,
                  const Matrix3d& axes) {
  Candidate candidate;
  candidate.axes = axes;
  const double min_cosine = std::cos(options.max_angle);
  const double scale = -0.5 / (options.last_bandwidth * options.last_bandwidth);
  Matrix3d sum = Matrix3d::Zero();
  for (size_t i = 0; i < evidence.all.size(); ++i) {
    const WeightedDirection& item = evidence.all[i];
    int axis = 0;
    const Vector3d cosines = axes.transpose() * item.direction;
    if (cosines.cwiseAbs().maxCoeff(&axis) < min_cosine) continue;
    (evidence.IsLine(i) ? candidate.num_lines : candidate.num_normals)[axis] += 1.0;
    candidate.share += item.weight;
    const Vector3d in_plane = item.direction / cosines[axis] - axes.col(axis);
    candidate.density += item.weight * std::exp(scale * in_plane.squaredNorm());
    sum.col(axis) += std::copysign(item.weight, cosines[axis]) * item.direction;
  }
  for (int i = 0; i < 3; ++i) {
    const Vector3d mean = sum.col(i);
    if (mean.norm() > 0.0) candidate.misfit[i] = UndirectedAngle(mean, Vector3d(axes.col(i)));
  }
  return candidate;
}

std::vector<Matrix3d> SpanCandidates(const Evidence& evidence) {
  const std::vector<Vector3d> modes =
      FindDirectionModes(evidence.all, kModeBandwidth, kModeSeparation, kMaxModes);
  std::vector<Matrix3d> candidates;
  for (size_t i = 0; i < modes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (std::abs(modes[i].dot(modes[j])) > std::sin(kPerpendicularTolerance)) continue;
      Matrix3d axes;
      axes << modes[j], modes[i], modes[j].cross(modes[i]);
      axes = NearestRotation(axes);
      const bool is_new = std::none_of(
          candidates.begin(), candidates.end(),
          [&](const Matrix3d& other) { return AngleBetweenAxes(other, axes) < kSameAxes; });
      if (is_new) candidates.push_back(axes);
    }
  }
  return candidates;
}

// Logarithm of the probability of k or more successes in n trials of probability p.
double LogBinomialTail(int n, int k, double p) {
  if (k <= 0) return 0.0;
  double tail = 0.0;
  for (int i = k; i <= n; ++i) {
    tail += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                     i * std::log(p) + (n - i) * std::log1p(-p));
  }
  return tail > 0.0 ? std::log(tail) : -std::numeric_limits<double>::infinity();
}

// Two members of n observations span a frame, so that these two are in its cones for nothing.
bool IsNoAccident(const CoarseAxesOptions& options, const Evidence& evidence,
                  const Candidate& candidate) {
  const double n = evidence.num_lines + evidence.NumNormals() / kNormalsPerObservation;
  const double k = candidate.num_lines.sum() + candidate.num_normals.sum() / kNormalsPerObservation;
  if (k < 3.0) return false;
  const double chance = 3.0 * (1.0 - std::cos(options.max_angle));
  const double log_tail = LogBinomialTail(static_cast<int>(n) - 2, static_cast<int>(k) - 2, chance);
  return std::log(0.5 * n * (n - 1.0)) + log_tail < std::log(options.max_false_alarms);
}

// A kind with few members has no vote of its own.
bool HasMajority(const CoarseAxesOptions& options, const Evidence& evidence,
                 const Candidate& candidate) {
  const double min_lines = options.min_explained_ratio * evidence.num_lines;
  const double min_normals = options.min_explained_ratio * evidence.NumNormals();
  return candidate.share >= options.min_explained_ratio &&
         (evidence.num_lines < kFullLines || candidate.num_lines.sum() >= min_lines) &&
         (evidence.NumNormals() < kFullNormals || candidate.num_normals.sum() >= min_normals);
}

bool IsVolume(const CoarseAxesOptions& options, const Evidence& evidence,
              const Candidate& candidate) {
  const double min_normals = options.min_axis_ratio * evidence.NumNormals();
  const double min_lines = std::max(kMinLinesOfAxis, options.min_axis_ratio * evidence.num_lines);
  int axes_with_surfaces = 0;
  int axes_with_lines = 0;
  for (int i = 0; i < 3; ++i) {
    if (candidate.num_normals[i] > 0.0 && candidate.num_normals[i] >= min_normals) {
      ++axes_with_surfaces;
    }
    if (candidate.num_lines[i] >= min_lines) ++axes_with_lines;
  }
  return axes_with_surfaces >= 2 || axes_with_lines == 3;
}

// Weight of what `a` explains and `b` does not.
double ExclusiveWeight(const CoarseAxesOptions& options, const Evidence& evidence,
                       const Matrix3d& a, const Matrix3d& b) {
  const double min_cosine = std::cos(options.max_angle);
  double weight = 0.0;
  for (const WeightedDirection& item : evidence.all) {
    const bool in_a = (a.transpose() * item.direction).cwiseAbs().maxCoeff() >= min_cosine;
    const bool in_b = (b.transpose() * item.direction).cwiseAbs().maxCoeff() >= min_cosine;
    if (in_a && !in_b) weight += item.weight;
  }
  return weight;
}

bool HasRival(const CoarseAxesOptions& options, const Evidence& evidence,
              const std::vector<Candidate>& candidates, const Matrix3d& best) {
  return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& other) {
    // Nearer ones have cones that overlap: they are the same axes, badly placed.
    if (AngleBetweenAxes(other.axes, best) < 2.0 * options.max_angle) return false;
    return ExclusiveWeight(options, evidence, other.axes, best) >
           options.max_rival * ExclusiveWeight(options, evidence, best, other.axes);
  });
}

bool IsAccepted(const CoarseAxesOptions& options, const Evidence& evidence,
                const Candidate& candidate) {
  return HasMajority(options, evidence, candidate) &&
         candidate.misfit.maxCoeff() <= options.max_misfit &&
         IsVolume(options, evidence, candidate) && IsNoAccident(options, evidence, candidate);
}

// Column i of the answer is column order[i] of `axes`, some of them negated; nearest to identity.
ManhattanAxes InCanonicalOrder(const Evidence& evidence, const Candidate& candidate) {
  std::array<int, 3> order = {0, 1, 2};
  std::array<int, 3> best_order = order;
  Matrix3d best = Matrix3d::Zero();
  double best_trace = -4.0;
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Matrix3d axes;
      for (int i = 0; i < 3; ++i) {
        axes.col(i) = (signs >> i & 1 ? -1.0 : 1.0) * candidate.axes.col(order[i]);
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
    result.line_ratio[i] = candidate.num_lines[best_order[i]] / num_lines;
    result.normal_ratio[i] = candidate.num_normals[best_order[i]] / num_normals;
  }
  result.share = candidate.share;
  return result;
}

}  // namespace

bool CoarseAxesOptions::IsValid(std::string* error) const {
  if (!(max_angle > 0.0 && max_angle < DegreesToRadians(45.0))) {
    *error = "max_angle must lie between 0 and pi/4 (radians): cones of two axes must not meet";
  } else if (!(max_sigma > 0.0)) {
    *error = "max_sigma must be positive (radians)";
  } else if (!(last_bandwidth > 0.0 && first_bandwidth >= last_bandwidth &&
               first_bandwidth < DegreesToRadians(15.0))) {
    *error = "0 < last_bandwidth <= first_bandwidth < 15 degrees (in radians) must hold";
  } else if (!(min_explained_ratio >= 0.0 && min_explained_ratio <= 1.0)) {
    *error = "min_explained_ratio must lie in [0, 1]";
  } else if (!(max_rival > 0.0 && max_rival <= 1.0)) {
    *error = "max_rival must lie in (0, 1]";
  } else if (!(min_axis_ratio >= 0.0 && min_axis_ratio <= 1.0)) {
    *error = "min_axis_ratio must lie in [0, 1]";
  } else if (!(max_misfit > 0.0)) {
    *error = "max_misfit must be positive (radians)";
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
  const Evidence evidence = Gather(options, lines, normals);
  std::vector<Candidate> candidates;
  for (const Matrix3d& axes : SpanCandidates(evidence)) {
    candidates.push_back(Measure(options, evidence, Climb(options, evidence, axes)));
  }
  const auto best = std::max_element(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.density < b.density; });
  if (best == candidates.end() || !IsAccepted(options, evidence, *best) ||
      HasRival(options, evidence, candidates, best->axes)) {
    return std::nullopt;
  }
  return InCanonicalOrder(evidence, *best);
}

}  // namespace msc_vo
