// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/frame_structure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/structure/frame_structure_factors.h"
#include "msc_vo/structure/internal/partner_selection.h"

namespace msc_vo {

namespace {

// Largest deviation of a pair's angle in sigmas of the measurement and of pair_sigma together: the
// 99.7 % quantile. Has no effect while max_angle is below three times pair_sigma, as by default.
constexpr double kGateSigmas = 3.0;
// Huber threshold of a pair, sigmas: the 95 % quantile.
constexpr double kHuber = 2.0;
// Bounds the time of a keyframe; most frames converge before.
constexpr int kMaxIterations = 10;

// Two lines that pass the gates.
struct Candidate {
  double sigma = 0.0;  // radians, of the angle between them
  int i = 0, j = 0;    // i < j
};

// Direction of a line and its uncertainty.
struct LineDirection {
  Eigen::Vector3d direction;
  double variance = 0.0;  // rad^2
};

void Validate(const FrameStructureOptions& options, const PinholeCamera& camera,
              const std::vector<StructureLine>& lines) {
  const auto fail = [](const std::string& what) {
    throw std::invalid_argument("RefineFrameStructure: " + what);
  };
  std::string error;
  if (!options.IsValid(&error) || !camera.IsValid(&error)) fail(error);
  for (size_t i = 0; i < lines.size(); ++i) {
    const StructureLine& line = lines[i];
    const char* what = LineObservationError(line.segment, line.sigma, true, line.depth);
    if (what == nullptr && !(line.depth.start > 0.0 && line.depth.end > 0.0)) {
      what = "inverse depth must be positive";
    }
    if (what != nullptr) fail("line " + std::to_string(i) + ": " + what);
  }
}

// Half of the variance of a pair is attributed to the deviations of the two lines, which all their
// pairs have in common (a quarter each); the other half to the pair itself.
InverseDepthLine MakeInverseDepthLine(const FrameStructureOptions& options,
                                      const PinholeCamera& camera, const StructureLine& line) {
  const double deviation = 0.5 * DegreesToRadians(options.pair_sigma);
  return InverseDepthLine(camera, line.segment, line.depth, line.sigma, deviation);
}
double PairSigma(const FrameStructureOptions& options) {
  return std::sqrt(0.5) * DegreesToRadians(options.pair_sigma);
}

std::vector<LineDirection> ComputeDirections(
    const PinholeCamera& camera, const std::vector<StructureLine>& lines,
    const std::vector<InverseDepthLine>& inverse_depth_lines) {
  std::vector<LineDirection> directions;
  for (size_t i = 0; i < lines.size(); ++i) {
    const double in_plane = DirectionSigma(camera, lines[i].segment, lines[i].depth);
    const double out_of_plane = inverse_depth_lines[i].image_angle();
    directions.push_back({BackProject(camera, lines[i].segment, lines[i].depth).Direction(),
                          in_plane * in_plane + out_of_plane * out_of_plane});
  }
  return directions;
}

// Counts of the relations of one line to all others.
struct RelationCounts {
  double num_certain = 0.0;    // lines with a sufficiently certain angle
  double num_unrelated = 0.0;  // of these, near neither 0 nor 90 degrees
  // Of these, partners, and their expected number among random directions.
  double num_parallel = 0.0, parallel_by_chance = 0.0;
  double num_perpendicular = 0.0, perpendicular_by_chance = 0.0;
};

// Series for angles (radians) up to 45 degrees with three digits, up to 5 degrees with seven, which
// suffices for probabilities.
double SmallSine(double x) { return x * (1.0 - x * x / 6.0); }
double SmallVersedSine(double x) { return 0.5 * x * x * (1.0 - x * x / 12.0); }

// Precomputed gates of a pair.
struct Gates {
  explicit Gates(const FrameStructureOptions& options)
      : max_angle(DegreesToRadians(options.max_angle)),
        cos_max_angle(std::cos(max_angle)),
        sin_max_angle(std::sin(max_angle)),
        pair_variance(std::pow(DegreesToRadians(options.pair_sigma), 2)) {}

  double max_angle, cos_max_angle, sin_max_angle;
  double pair_variance;  // rad^2, of the true angle of a pair
};

// Updates the counts of lines i and j, and adds the pair to the candidates if it passes the gates.
void EvaluatePair(const Gates& gates, const std::vector<LineDirection>& lines, int i, int j,
                  std::vector<RelationCounts>* counts, std::vector<Candidate>* parallel,
                  std::vector<Candidate>* perpendicular) {
  const double sigma = std::sqrt(lines[i].variance + lines[j].variance + gates.pair_variance);
  // A less certain angle would pass the gate by chance.
  if (sigma > gates.max_angle) return;
  const double gate = std::min(gates.max_angle, kGateSigmas * sigma);
  const Eigen::Vector3d &a = lines[i].direction, &b = lines[j].direction;
  // Most pairs are near neither 0 nor 90 degrees; the test of their cosine saves the arc cosine.
  const double cosine = std::abs(a.dot(b));
  const bool may_be_parallel = cosine >= gates.cos_max_angle;
  const bool may_be_perpendicular = cosine <= gates.sin_max_angle;
  const bool is_unrelated = !may_be_parallel && !may_be_perpendicular;
  const double angle = is_unrelated ? 0.25 * kPi : UndirectedAngle(a, b);
  const bool is_parallel = may_be_parallel && angle <= gate;
  const bool is_perpendicular = may_be_perpendicular && angle >= 0.5 * kPi - gate;
  // The cosine between random directions is uniform in [0, 1].
  const double sine = SmallSine(gate), versed_sine = SmallVersedSine(gate);
  for (RelationCounts* n : {&(*counts)[i], &(*counts)[j]}) {
    n->num_certain += 1.0;
    n->num_unrelated += is_unrelated;
    n->num_parallel += is_parallel;
    n->num_perpendicular += is_perpendicular;
    n->parallel_by_chance += versed_sine;
    n->perpendicular_by_chance += sine;
  }
  if (is_parallel) parallel->push_back({sigma, i, j});
  if (is_perpendicular) perpendicular->push_back({sigma, i, j});
}

// Finds all pairs with angles near 0 and near 90 degrees. In a scene without structure, every
// eleventh pair is within 5 degrees of 90 by chance. The number of such pairs of a line is
// estimated from its unrelated lines, with angles in between. A line is excluded unless it has at
// least twice as many partners as expected by chance.
void FindPairs(const FrameStructureOptions& options, const std::vector<LineDirection>& lines,
               std::vector<Candidate>* parallel, std::vector<Candidate>* perpendicular) {
  const Gates gates(options);
  std::vector<RelationCounts> counts(lines.size());
  for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(lines.size()); ++j) {
      EvaluatePair(gates, lines, i, j, &counts, parallel, perpendicular);
    }
  }
  // Ratio of unrelated lines among random directions.
  const double unrelated_ratio = gates.cos_max_angle - gates.sin_max_angle;
  const auto random_ratio = [&](const RelationCounts& n) {
    return n.num_unrelated / (unrelated_ratio * n.num_certain);
  };
  const auto erase_if = [](std::vector<Candidate>* pairs, const auto& is_chance) {
    EraseIf(pairs, [&](const Candidate& pair) { return is_chance(pair.i) || is_chance(pair.j); });
  };
  erase_if(parallel, [&](int line) {
    const RelationCounts& n = counts[line];
    return n.num_parallel < 2.0 * random_ratio(n) * n.parallel_by_chance;
  });
  erase_if(perpendicular, [&](int line) {
    const RelationCounts& n = counts[line];
    return n.num_perpendicular < 2.0 * random_ratio(n) * n.perpendicular_by_chance;
  });
}

// Builds the factors of the lines that have a partner, and returns the indices of these lines.
std::vector<int> BuildFactors(const FrameStructureOptions& options,
                              const std::vector<StructureLine>& lines,
                              const std::vector<InverseDepthLine>& inverse_depth_lines,
                              const std::vector<Candidate>& parallel,
                              const std::vector<Candidate>& perpendicular,
                              FrameStructureFactors* factors) {
  std::vector<int> position(lines.size(), -1);
  for (const std::vector<Candidate>* pairs : {&parallel, &perpendicular}) {
    for (const Candidate& pair : *pairs) position[pair.i] = position[pair.j] = 0;
  }
  std::vector<int> refined;
  for (size_t i = 0; i < lines.size(); ++i) {
    if (position[i] < 0) continue;
    position[i] = static_cast<int>(refined.size());
    refined.push_back(static_cast<int>(i));
    factors->lines.push_back(inverse_depth_lines[i]);
    factors->priors.emplace_back(lines[i].depth);
  }
  const double sigma = PairSigma(options);
  for (const Candidate& pair : parallel) {
    factors->parallel.push_back({ParallelLines(sigma), position[pair.i], position[pair.j]});
  }
  for (const Candidate& pair : perpendicular) {
    factors->perpendicular.push_back(
        {PerpendicularLines(sigma), position[pair.i], position[pair.j]});
  }
  factors->huber = kHuber;
  return refined;
}

}  // namespace

bool FrameStructureOptions::IsValid(std::string* error) const {
  if (!(max_angle > 0.0 && max_angle < 45.0)) {
    *error = "frame_structure.max_angle must be in (0, 45) degrees";
  } else if (!(std::isfinite(pair_sigma) && pair_sigma > 0.0)) {
    *error = "frame_structure.pair_sigma must be positive";
  } else {
    return true;
  }
  return false;
}

FrameStructureSummary RefineFrameStructure(const FrameStructureOptions& options,
                                           const PinholeCamera& camera,
                                           std::vector<StructureLine>* lines) {
  Validate(options, camera, *lines);
  std::vector<InverseDepthLine> inverse_depth_lines;
  for (const StructureLine& l : *lines)
    inverse_depth_lines.push_back(MakeInverseDepthLine(options, camera, l));
  std::vector<Candidate> parallel, perpendicular;
  FindPairs(options, ComputeDirections(camera, *lines, inverse_depth_lines), &parallel,
            &perpendicular);
  SelectMostCertain(lines->size(), &parallel);
  SelectMostCertain(lines->size(), &perpendicular);

  FrameStructureFactors factors;
  const std::vector<int> refined =
      BuildFactors(options, *lines, inverse_depth_lines, parallel, perpendicular, &factors);
  FrameStructureSummary summary;
  summary.num_parallel = static_cast<int>(parallel.size());
  summary.num_perpendicular = static_cast<int>(perpendicular.size());
  std::vector<InverseDepthLineBlock> blocks;
  for (const int i : refined) {
    blocks.emplace_back((*lines)[i].depth.start, (*lines)[i].depth.end, 0.0, 0.0);
  }
  StructureEquations equations;
  if (refined.empty() || !MinimizeStructure(factors, kMaxIterations, &blocks, &equations)) {
    return summary;
  }
  summary.usable = true;
  const auto covariances = BoundCovariances(factors, equations);
  for (size_t k = 0; k < refined.size(); ++k) {
    // A line that would pass through infinity keeps its fit.
    if (!(blocks[k][0] > 0.0 && blocks[k][1] > 0.0)) continue;
    LineDepth& depth = (*lines)[refined[k]].depth;
    depth.start = blocks[k][0];
    depth.end = blocks[k][1];
    depth.covariance = covariances[k].topLeftCorner<2, 2>();
  }
  return summary;
}

}  // namespace msc_vo
