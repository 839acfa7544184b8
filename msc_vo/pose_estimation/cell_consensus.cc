// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/cell_consensus.h"

#include <algorithm>
#include <array>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/pose_estimation/image_grid.h"
#include "msc_vo/pose_estimation/pose_matches.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The parts that each match is in.
struct Membership {
  std::vector<int> of_points;
  std::vector<std::vector<int>> of_lines;
};

Membership FindMembers(const ImageGrid& parts, const PoseData& data) {
  Membership members;
  for (const PoseData::Point& p : data.points) members.of_points.push_back(parts.CellOf(p.pixel));
  for (const PoseData::Line& l : data.lines) members.of_lines.push_back(parts.CellsOf(l.segment));
  return members;
}

// What one part says of a step d from the pose that its equations are for.
struct Vote {
  double weight = 0.0;       // 1 if all of it is proven
  double num_matches = 0.0;  // a line in n parts counts 1/n in each
  double num_confirmed = 0.0;
  NormalEquations equations;
  double gain = 0.0;  // of the part's own best step, in squared sigmas

  void Add(const NormalEquations& match, bool is_proven, double share) {
    equations.hessian += share * match.hessian;
    equations.gradient += share * match.gradient;
    num_matches += share;
    num_confirmed += is_proven ? share : 0.0;
  }
  // How many squared sigmas d leaves that the part's own best step would not.
  double Misfit(const Vector6& d) const {
    return std::max(0.0, d.dot(equations.hessian * d + 2.0 * equations.gradient) + gain);
  }
};

using Votes = std::vector<Vote>;  // by part; one without matches has no weight

// What a step of their own would gain; directions that a part does not see gain nothing.
double OwnGain(const NormalEquations& equations) {
  Matrix6 damped = equations.hessian;
  damped.diagonal() *= 1.0 + 1e-6;
  damped.diagonal().array() += 1e-12 * equations.hessian.trace();
  return equations.gradient.dot(damped.ldlt().solve(equations.gradient));
}

// Outliers vote with the others: they may be those who are right.
Votes CollectVotes(const PoseOptions& options, const PoseData& data, int num_parts,
                   const Membership& members, const Rigid3& pose) {
  const PoseInlierMask active = AllInFront(options, data, pose);
  Votes votes(num_parts);
  PoseFactors match;
  SetLosses(options, &match);
  NormalEquations equations;
  for (size_t i = 0; i < data.points.size(); ++i) {
    match.Clear();
    AddFactors(options, data.camera, data.points[i], active.points[i], &match);
    if (match.NumRows() == 0 || !match.Linearize(pose, &equations)) continue;
    votes[members.of_points[i]].Add(equations, data.points[i].confirmed, 1.0);
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    match.Clear();
    AddFactors(options, data.camera, data.lines[i], active.lines[i], pose, &match);
    if (match.NumRows() == 0 || !match.Linearize(pose, &equations)) continue;
    const double share = 1.0 / static_cast<double>(members.of_lines[i].size());
    for (const int part : members.of_lines[i]) {
      votes[part].Add(equations, data.lines[i].confirmed, share);
    }
  }
  for (Vote& vote : votes) {
    if (vote.num_matches == 0.0) continue;
    const double proven = vote.num_confirmed / vote.num_matches;
    vote.weight = proven + (1.0 - proven) * options.consensus.unconfirmed_weight;
    vote.gain = OwnGain(vote.equations);
  }
  return votes;
}

// A step, and what all parts have against it.
struct Step {
  Vector6 d = Vector6::Zero();
  double misfit = 0.0;
};

double TotalMisfit(const Votes& votes, const Vector6& d, double limit) {
  double sum = 0.0;
  for (const Vote& vote : votes) sum += vote.weight * std::min(limit, vote.Misfit(d));
  return sum;
}

// Minimum of the sum of squares with a weight for every vote. What these do not see stays where it
// is: a ten-thousandth of all hessians holds it there.
template <typename Weight>
Vector6 WeightedMinimum(const Votes& votes, const Matrix6& all, const Weight& weight) {
  Matrix6 hessian = 1e-4 * all;
  Vector6 gradient = Vector6::Zero();
  for (size_t part = 0; part < votes.size(); ++part) {
    const double w = weight(static_cast<int>(part));
    if (w == 0.0) continue;
    hessian += w * votes[part].equations.hessian;
    gradient += w * votes[part].equations.gradient;
  }
  return -hessian.ldlt().solve(gradient);
}

// Where the search begins: the best step of a region that something else may leave free. No two of
// a pair have a part in common, as one row of parts of the wrong ones spoils a region.
struct Region {
  double left, top, right, bottom;  // shares of the image's width and height
  bool Contains(const Eigen::Vector2d& x) const {
    return x.x() > left && x.x() < right && x.y() > top && x.y() < bottom;
  }
};
constexpr double kThird = 1.0 / 3.0;
constexpr std::array<Region, 10> kRegions{{{0.0, 0.0, 1.0, 1.0},
                                           {0.0, 0.0, 0.5, 1.0},
                                           {0.5, 0.0, 1.0, 1.0},
                                           {0.0, 0.0, 1.0, 0.5},
                                           {0.0, 0.5, 1.0, 1.0},
                                           {0.0, 0.0, kThird, 1.0},
                                           {kThird, 0.0, 1.0 - kThird, 1.0},
                                           {1.0 - kThird, 0.0, 1.0, 1.0},
                                           {0.0, 0.0, 1.0, kThird},
                                           {0.0, 1.0 - kThird, 1.0, 1.0}}};
// Steps of reweighting (Geman and McClure) from each of them, fewer if one gains less than 1 %.
constexpr int kReweightings = 5;
constexpr double kSmallGain = 0.01;

Step FindBestStep(const ImageGrid& parts, const Votes& votes, double limit) {
  Step best{Vector6::Zero(), TotalMisfit(votes, Vector6::Zero(), limit)};
  Matrix6 all = Matrix6::Zero();
  for (const Vote& vote : votes) all += vote.equations.hessian;
  for (const Region& region : kRegions) {
    Step step;
    step.d = WeightedMinimum(
        votes, all, [&](int part) { return region.Contains(parts.CenterOf(part)) ? 1.0 : 0.0; });
    for (int i = 0; i < kReweightings; ++i) {
      const double last = step.misfit;
      step.misfit = TotalMisfit(votes, step.d, limit);
      if (step.misfit < best.misfit) best = step;
      if (i > 0 && step.misfit > (1.0 - kSmallGain) * last) break;
      step.d = WeightedMinimum(votes, all, [&](int part) {
        const double w = limit / (limit + votes[part].Misfit(step.d));
        return votes[part].weight * w * w;
      });
    }
  }
  return best;
}

// Weights of the parts that vote against d.
double WeightAgainst(const Votes& votes, const Vector6& d, double limit) {
  double sum = 0.0;
  for (const Vote& vote : votes) sum += vote.Misfit(d) > limit ? vote.weight : 0.0;
  return sum;
}

}  // namespace

std::optional<CellConsensus> FindCellConsensus(const PoseOptions& options, const PoseData& data,
                                               const Rigid3& pose) {
  // Equations are made anew where the last ones led.
  constexpr int kRounds = 3;
  const double limit = options.consensus.reject_chi2_6;
  const double min_cells = options.consensus.min_cells;
  const ImageGrid parts(options.consensus.columns, options.consensus.rows, data.camera);
  const Membership members = FindMembers(parts, data);
  Votes votes = CollectVotes(options, data, parts.size(), members, pose);
  // Not worth a search where no more parts disagree than another pose must win.
  if (WeightAgainst(votes, Vector6::Zero(), limit) <= min_cells) return std::nullopt;
  const double misfit = TotalMisfit(votes, Vector6::Zero(), limit);
  Rigid3 best = pose;
  Step step;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) votes = CollectVotes(options, data, parts.size(), members, best);
    step = FindBestStep(parts, votes, limit);
    // Half of what is asked, as the next equations may show the rest.
    if (misfit - step.misfit <= 0.5 * min_cells * limit) return std::nullopt;
    const Rigid3 from = best;
    Rigid3Manifold().Plus(from.params.data(), step.d.data(), best.params.data());
  }
  if (misfit - step.misfit <= min_cells * limit) return std::nullopt;
  CellConsensus consensus{best, {}};
  for (const Vote& vote : votes) consensus.dynamic_cells.push_back(vote.Misfit(step.d) > limit);
  return consensus;
}

}  // namespace msc_vo
