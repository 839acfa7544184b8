// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/pose_consensus.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/problems/pose_matches.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The parts of an image, row by row.
class PartGrid {
 public:
  PartGrid(const ConsensusOptions& options, const PinholeCamera& camera)
      : columns_(options.columns),
        rows_(options.rows),
        per_pixel_x_(options.columns / static_cast<double>(camera.width)),
        per_pixel_y_(options.rows / static_cast<double>(camera.height)) {}

  int PartOf(const Eigen::Vector2d& pixel) const {
    // Undistortion moves some pixels out of the image.
    const double column = std::clamp(pixel.x() * per_pixel_x_, 0.0, columns_ - 1.0);
    const double row = std::clamp(pixel.y() * per_pixel_y_, 0.0, rows_ - 1.0);
    return static_cast<int>(row) * columns_ + static_cast<int>(column);
  }
  // Those that a segment runs through, looked up four times per part.
  std::vector<int> PartsOf(const LineSegment2& segment) const {
    const Eigen::Vector2d along = segment.end - segment.start;
    const int steps = 1 + static_cast<int>(4.0 * std::max(std::abs(along.x()) * per_pixel_x_,
                                                          std::abs(along.y()) * per_pixel_y_));
    std::vector<int> parts;
    for (int k = 0; k <= steps; ++k) {
      parts.push_back(PartOf(segment.start + static_cast<double>(k) / steps * along));
    }
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    return parts;
  }
  // Centre of a part, as a share of the image's width and height.
  Eigen::Vector2d CenterOf(int part) const {
    return {(part % columns_ + 0.5) / columns_, (part / columns_ + 0.5) / rows_};
  }

 private:
  int columns_;
  int rows_;
  double per_pixel_x_;
  double per_pixel_y_;
};

// The parts that each match is in.
struct Membership {
  std::vector<int> of_points;
  std::vector<std::vector<int>> of_lines;
};

Membership FindParts(const PartGrid& grid, const PoseData& data) {
  Membership parts;
  for (const PoseData::Point& p : data.points) parts.of_points.push_back(grid.PartOf(p.pixel));
  for (const PoseData::Line& l : data.lines) parts.of_lines.push_back(grid.PartsOf(l.segment));
  return parts;
}

// What one part says of a step d from the pose that its equations are for.
struct Vote {
  double weight = 0.0;       // 1 if all of it is proven
  double num_matches = 0.0;  // a line in n parts counts 1/n in each
  double num_proven = 0.0;
  NormalEquations equations;
  double gain = 0.0;  // of the part's own best step, in squared sigmas

  void Add(const NormalEquations& match, bool is_proven, double share) {
    equations.hessian += share * match.hessian;
    equations.gradient += share * match.gradient;
    num_matches += share;
    num_proven += is_proven ? share : 0.0;
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
Votes CollectVotes(const PoseOptions& options, const PoseData& data, const Membership& parts,
                   const Rigid3& pose) {
  const PoseActivities active = AllInFront(options, data, pose);
  Votes votes(options.consensus.columns * options.consensus.rows);
  PoseFactors match;
  SetLosses(options, &match);
  NormalEquations equations;
  for (size_t i = 0; i < data.points.size(); ++i) {
    match.Clear();
    AddFactors(options, data.camera, data.points[i], active.points[i], &match);
    if (match.NumRows() == 0 || !match.Linearize(pose, &equations)) continue;
    votes[parts.of_points[i]].Add(equations, data.points[i].proven, 1.0);
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    match.Clear();
    AddFactors(options, data.camera, data.lines[i], active.lines[i], pose, &match);
    if (match.NumRows() == 0 || !match.Linearize(pose, &equations)) continue;
    const double share = 1.0 / static_cast<double>(parts.of_lines[i].size());
    for (const int part : parts.of_lines[i]) {
      votes[part].Add(equations, data.lines[i].proven, share);
    }
  }
  for (Vote& vote : votes) {
    if (vote.num_matches == 0.0) continue;
    const double proven = vote.num_proven / vote.num_matches;
    vote.weight = proven + (1.0 - proven) * options.consensus.unproven_weight;
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

Step FindBestStep(const PartGrid& grid, const Votes& votes, double limit) {
  Step best{Vector6::Zero(), TotalMisfit(votes, Vector6::Zero(), limit)};
  Matrix6 all = Matrix6::Zero();
  for (const Vote& vote : votes) all += vote.equations.hessian;
  for (const Region& region : kRegions) {
    Step step;
    step.d = WeightedMinimum(
        votes, all, [&](int part) { return region.Contains(grid.CenterOf(part)) ? 1.0 : 0.0; });
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

PoseConsensus MakeConsensus(const PartGrid& grid, const PoseData& data, const Votes& votes,
                            const Vector6& d, double limit, const Rigid3& cam_from_world) {
  const auto moves = [&](const Eigen::Vector2d& pixel) {
    return votes[grid.PartOf(pixel)].Misfit(d) > limit;
  };
  PoseConsensus consensus;
  consensus.cam_from_world = cam_from_world;
  for (const PoseData::Point& p : data.points) consensus.moving_points.push_back(moves(p.pixel));
  for (const PoseData::Line& l : data.lines) {
    consensus.moving_lines.push_back(moves(0.5 * (l.segment.start + l.segment.end)));
  }
  return consensus;
}

}  // namespace

std::optional<PoseConsensus> FindConsensus(const PoseOptions& options, const PoseData& data,
                                           const Rigid3& pose) {
  // Equations are made anew where the last ones led.
  constexpr int kRounds = 3;
  const double limit = options.consensus.reject_chi2_6;
  const double min_parts = options.consensus.min_parts;
  const PartGrid grid(options.consensus, data.camera);
  const Membership parts = FindParts(grid, data);
  Votes votes = CollectVotes(options, data, parts, pose);
  // Not worth a search where no more parts disagree than another pose must win.
  if (WeightAgainst(votes, Vector6::Zero(), limit) <= min_parts) return std::nullopt;
  const double misfit = TotalMisfit(votes, Vector6::Zero(), limit);
  Rigid3 best = pose;
  Step step;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) votes = CollectVotes(options, data, parts, best);
    step = FindBestStep(grid, votes, limit);
    // Half of what is asked, as the next equations may show the rest.
    if (misfit - step.misfit <= 0.5 * min_parts * limit) return std::nullopt;
    const Rigid3 from = best;
    Rigid3Manifold().Plus(from.params.data(), step.d.data(), best.params.data());
  }
  if (misfit - step.misfit <= min_parts * limit) return std::nullopt;
  return MakeConsensus(grid, data, votes, step.d, limit, best);
}

}  // namespace msc_vo
