// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/frame_structure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/frame_structure_factors.h"

namespace msc_vo {

namespace {

// Two lines that pass the gates.
struct Candidate {
  double sigma = 0.0;  // radians, of the angle between them
  int i = 0, j = 0;    // i < j
  bool chosen = false;
};

// A line as the search of pairs sees it.
struct Oriented {
  Eigen::Vector3d direction;
  double variance = 0.0;  // of the direction, rad^2
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

// Half of a pair's variance is taken to be the two lines' own deviations from how they were meant,
// a quarter each, common to all their pairs; the other half the pair's own.
InverseDepthLine MakeInverseDepthLine(const FrameStructureOptions& options,
                                      const PinholeCamera& camera, const StructureLine& line) {
  const double deviation = 0.5 * DegreesToRadians(options.pair_sigma);
  return InverseDepthLine(camera, line.segment, line.depth, line.sigma, deviation);
}
double PairSigma(const FrameStructureOptions& options) {
  return std::sqrt(0.5) * DegreesToRadians(options.pair_sigma);
}

std::vector<Oriented> Orient(const PinholeCamera& camera, const std::vector<StructureLine>& lines,
                             const std::vector<InverseDepthLine>& inverse_depth_lines) {
  std::vector<Oriented> oriented;
  for (size_t i = 0; i < lines.size(); ++i) {
    const double in_plane = DirectionSigma(camera, lines[i].segment, lines[i].depth);
    const double out_of_plane = inverse_depth_lines[i].image_angle();
    oriented.push_back({BackProject(camera, lines[i].segment, lines[i].depth).Direction(),
                        in_plane * in_plane + out_of_plane * out_of_plane});
  }
  return oriented;
}

// What one line sees of all the others.
struct Neighbourhood {
  double num_told = 0.0;       // whose angle is known well enough to tell
  double num_unrelated = 0.0;  // of these, near neither 0 nor 90 degrees
  // Of these, partners; and their number if each angle were of two random directions.
  double num_parallel = 0.0, parallel_by_chance = 0.0;
  double num_perpendicular = 0.0, perpendicular_by_chance = 0.0;
};

// Of angles up to 45 degrees, to three digits, and to seven up to 5: enough for probabilities.
double SmallSine(double x) { return x * (1.0 - x * x / 6.0); }
double SmallVersedSine(double x) { return 0.5 * x * x * (1.0 - x * x / 12.0); }

// What decides whether two lines are a pair.
struct Gates {
  explicit Gates(const FrameStructureOptions& options)
      : max_angle(DegreesToRadians(options.max_angle)),
        cos_max_angle(std::cos(max_angle)),
        sin_max_angle(std::sin(max_angle)),
        pair_variance(std::pow(DegreesToRadians(options.pair_sigma), 2)),
        sigmas(options.gate_sigmas) {}

  double max_angle, cos_max_angle, sin_max_angle;
  double pair_variance;  // rad^2, of the angle of what was built so
  double sigmas;
};

// Looks at one pair: adds it to what both lines see, and to the candidates if it passes.
void LookAt(const Gates& gates, const std::vector<Oriented>& lines, int i, int j,
            std::vector<Neighbourhood>* seen, std::vector<Candidate>* parallel,
            std::vector<Candidate>* perpendicular) {
  const double sigma = std::sqrt(lines[i].variance + lines[j].variance + gates.pair_variance);
  // Were the angle known worse than the gate is wide, being inside it would say nothing.
  if (sigma > gates.max_angle) return;
  const double gate = std::min(gates.max_angle, gates.sigmas * sigma);
  const Eigen::Vector3d &a = lines[i].direction, &b = lines[j].direction;
  // Most pairs are near neither to 0 nor to 90 degrees, which their cosine tells at once.
  const double cosine = std::abs(a.dot(b));
  const bool may_be_parallel = cosine >= gates.cos_max_angle;
  const bool may_be_perpendicular = cosine <= gates.sin_max_angle;
  const bool is_unrelated = !may_be_parallel && !may_be_perpendicular;
  const double angle = is_unrelated ? 0.25 * kPi : UndirectedAngle(a, b);
  const bool is_parallel = may_be_parallel && angle <= gate;
  const bool is_perpendicular = may_be_perpendicular && angle >= 0.5 * kPi - gate;
  // The cosine between random directions is uniform in [0, 1].
  const double sine = SmallSine(gate), versed_sine = SmallVersedSine(gate);
  for (Neighbourhood* n : {&(*seen)[i], &(*seen)[j]}) {
    n->num_told += 1.0;
    n->num_unrelated += is_unrelated;
    n->num_parallel += is_parallel;
    n->num_perpendicular += is_perpendicular;
    n->parallel_by_chance += versed_sine;
    n->perpendicular_by_chance += sine;
  }
  if (is_parallel) parallel->push_back({sigma, i, j, false});
  if (is_perpendicular) perpendicular->push_back({sigma, i, j, false});
}

// All pairs with angles near 0 and near 90 degrees, but for lines that have no more of them than
// chance would give: in a scene without structure, every eleventh pair is within 5 degrees of 90.
// Chance is told from the angles in between: their share says how much of what a line sees is
// random to it. At least every second of the partners must be more than that.
void FindPairs(const FrameStructureOptions& options, const std::vector<Oriented>& lines,
               std::vector<Candidate>* parallel, std::vector<Candidate>* perpendicular) {
  const Gates gates(options);
  std::vector<Neighbourhood> seen(lines.size());
  for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(lines.size()); ++j) {
      LookAt(gates, lines, i, j, &seen, parallel, perpendicular);
    }
  }
  const double between = gates.cos_max_angle - gates.sin_max_angle;  // their share if all is random
  const auto random_share = [&](const Neighbourhood& n) {
    return n.num_unrelated / (between * n.num_told);
  };
  const auto erase_if = [](std::vector<Candidate>* pairs, const auto& is_chance) {
    pairs->erase(std::remove_if(
                     pairs->begin(), pairs->end(),
                     [&](const Candidate& pair) { return is_chance(pair.i) || is_chance(pair.j); }),
                 pairs->end());
  };
  erase_if(parallel, [&](int line) {
    const Neighbourhood& n = seen[line];
    return n.num_parallel < 2.0 * random_share(n) * n.parallel_by_chance;
  });
  erase_if(perpendicular, [&](int line) {
    const Neighbourhood& n = seen[line];
    return n.num_perpendicular < 2.0 * random_share(n) * n.perpendicular_by_chance;
  });
}

// Keeps the pairs that either line counts among its best. A well-known line may serve many.
void KeepBest(int max_partners, size_t num_lines, std::vector<Candidate>* pairs) {
  std::sort(pairs->begin(), pairs->end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.sigma, a.i, a.j) < std::tie(b.sigma, b.i, b.j);
  });
  std::vector<int> num_chosen(num_lines, 0);
  const auto choose = [&](int line) { return num_chosen[line]++ < max_partners; };
  for (Candidate& pair : *pairs) {
    const bool by_i = choose(pair.i), by_j = choose(pair.j);
    pair.chosen = by_i || by_j;
  }
  pairs->erase(std::remove_if(pairs->begin(), pairs->end(),
                              [](const Candidate& pair) { return !pair.chosen; }),
               pairs->end());
}

// Positions of the lines that have a partner, and the factors over them.
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
  factors->huber = options.huber;
  return refined;
}

}  // namespace

bool FrameStructureOptions::IsValid(std::string* error) const {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!(max_angle > 0.0 && max_angle < 45.0)) {
    *error = "frame_structure.max_angle must be in (0, 45) degrees";
  } else if (!is_positive(pair_sigma) || !is_positive(gate_sigmas) || !is_positive(huber)) {
    *error = "frame_structure.pair_sigma, gate_sigmas and huber must be positive";
  } else if (max_partners < 1 || max_iterations < 1) {
    *error = "frame_structure.max_partners and max_iterations must be at least 1";
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
  FindPairs(options, Orient(camera, *lines, inverse_depth_lines), &parallel, &perpendicular);
  KeepBest(options.max_partners, lines->size(), &parallel);
  KeepBest(options.max_partners, lines->size(), &perpendicular);

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
  if (refined.empty() || !factors.Linearize(blocks, &equations)) return summary;
  summary.initial_cost = equations.cost;
  if (!MinimizeStructure(factors, options.max_iterations, &blocks, &equations,
                         &summary.num_iterations)) {
    return summary;
  }
  summary.usable = true;
  summary.final_cost = equations.cost;
  const auto covariances = BoundCovariances(factors, equations);
  for (size_t k = 0; k < refined.size(); ++k) {
    // A line that would leave through infinity keeps its fit.
    if (!(blocks[k][0] > 0.0 && blocks[k][1] > 0.0)) continue;
    LineDepth& depth = (*lines)[refined[k]].depth;
    depth.start = blocks[k][0];
    depth.end = blocks[k][1];
    depth.covariance = covariances[k].topLeftCorner<2, 2>();
    ++summary.num_refined;
  }
  return summary;
}

}  // namespace msc_vo
