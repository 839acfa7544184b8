// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/pose_consensus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

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
    const int column = static_cast<int>(pixel.x() * per_pixel_x_);
    const int row = static_cast<int>(pixel.y() * per_pixel_y_);
    return std::clamp(row, 0, rows_ - 1) * columns_ + std::clamp(column, 0, columns_ - 1);
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

// What one part says of a step d from the pose that its equations are for.
struct Vote {
  int part = 0;
  double weight = 0.0;
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double gain = 0.0;  // of the part's own best step, in squared sigmas

  // How many squared sigmas d leaves that the part's own best step would not.
  double Misfit(const Vector6& d) const {
    return std::max(0.0, d.dot(hessian * d) + 2.0 * gradient.dot(d) + gain);
  }
};

using Votes = std::vector<Vote>;

// A match in one of the parts that it is in.
struct Member {
  int part;
  bool is_line;
  size_t match;
  int num_parts;  // share their information
  bool operator<(const Member& other) const {
    return std::tie(part, is_line, match) < std::tie(other.part, other.is_line, other.match);
  }
};

std::vector<Member> MembersOfParts(const PartGrid& grid, const PoseData& data) {
  std::vector<Member> members;
  for (size_t i = 0; i < data.points.size(); ++i) {
    members.push_back({grid.PartOf(data.points[i].pixel), false, i, 1});
  }
  for (size_t i = 0; i < data.lines.size(); ++i) {
    const std::vector<int> parts = grid.PartsOf(data.lines[i].segment);
    for (const int part : parts) {
      members.push_back({part, true, i, static_cast<int>(parts.size())});
    }
  }
  std::sort(members.begin(), members.end());
  return members;
}

// A line that tells n parts of an image what it tells has n times the variance in each.
PoseData::Line Shared(PoseData::Line line, int num_parts) {
  line.sigma *= std::sqrt(num_parts);
  line.depth.covariance *= num_parts;
  return line;
}

// What a step of their own would gain; directions that a part does not see gain nothing.
double OwnGain(const NormalEquations& equations) {
  Matrix6 damped = equations.hessian;
  damped.diagonal() *= 1.0 + 1e-6;
  damped.diagonal().array() += 1e-12 * equations.hessian.trace();
  return equations.gradient.dot(damped.ldlt().solve(equations.gradient));
}

// The members from `first` to `last` are those of one part. No vote if none is in front of the
// camera.
template <typename Iterator>
Vote VoteOf(const PoseOptions& options, const PoseData& data, const PoseActivities& active,
            const Rigid3& pose, Iterator first, Iterator last) {
  Vote vote;
  vote.part = first->part;
  PoseFactors factors;
  SetLosses(options, &factors);
  int num_proven = 0;
  for (Iterator member = first; member != last; ++member) {
    const size_t i = member->match;
    if (member->is_line) {
      AddFactors(options, data.camera, Shared(data.lines[i], member->num_parts), active.lines[i],
                 pose, &factors);
      num_proven += data.lines[i].proven;
    } else {
      AddFactors(options, data.camera, data.points[i], active.points[i], &factors);
      num_proven += data.points[i].proven;
    }
  }
  NormalEquations equations;
  if (factors.NumRows() == 0 || !factors.Linearize(pose, &equations)) return vote;
  const double share = num_proven / static_cast<double>(last - first);
  vote.weight = share + (1.0 - share) * options.consensus.unproven_weight;
  vote.hessian = equations.hessian;
  vote.gradient = equations.gradient;
  vote.gain = OwnGain(equations);
  return vote;
}

// Outliers vote with the others: they may be those who are right.
Votes CollectVotes(const PoseOptions& options, const PoseData& data,
                   const std::vector<Member>& members, const Rigid3& pose) {
  const PoseActivities active = AllInFront(options, data, pose);
  Votes votes;
  for (auto first = members.begin(); first != members.end();) {
    const auto last = std::find_if(first, members.end(), [&first](const Member& member) {
      return member.part != first->part;
    });
    const Vote vote = VoteOf(options, data, active, pose, first, last);
    if (vote.weight > 0.0) votes.push_back(vote);
    first = last;
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
  for (const Vote& vote : votes) {
    const double w = weight(vote);
    hessian += w * vote.hessian;
    gradient += w * vote.gradient;
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
// Steps of reweighting (Geman and McClure) from each of them.
constexpr int kReweightings = 5;

Step FindBestStep(const PartGrid& grid, const Votes& votes, double limit) {
  Step best{Vector6::Zero(), TotalMisfit(votes, Vector6::Zero(), limit)};
  Matrix6 all = Matrix6::Zero();
  for (const Vote& vote : votes) all += vote.hessian;
  for (const Region& region : kRegions) {
    Vector6 d = WeightedMinimum(votes, all, [&](const Vote& vote) {
      return region.Contains(grid.CenterOf(vote.part)) ? 1.0 : 0.0;
    });
    for (int i = 0; i < kReweightings; ++i) {
      const double misfit = TotalMisfit(votes, d, limit);
      if (misfit < best.misfit) best = {d, misfit};
      d = WeightedMinimum(votes, all, [&](const Vote& vote) {
        const double w = limit / (limit + vote.Misfit(d));
        return vote.weight * w * w;
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
  std::vector<int> against;  // ascending
  for (const Vote& vote : votes) {
    if (vote.Misfit(d) > limit) against.push_back(vote.part);
  }
  const auto moves = [&](const Eigen::Vector2d& pixel) {
    return std::binary_search(against.begin(), against.end(), grid.PartOf(pixel));
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
  const std::vector<Member> members = MembersOfParts(grid, data);
  Votes votes = CollectVotes(options, data, members, pose);
  // Others cannot have more votes than there are against this one.
  if (WeightAgainst(votes, Vector6::Zero(), limit) <= min_parts) return std::nullopt;
  const double misfit = TotalMisfit(votes, Vector6::Zero(), limit);
  Rigid3 best = pose;
  Step step;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) votes = CollectVotes(options, data, members, best);
    step = FindBestStep(grid, votes, limit);
    const Rigid3 from = best;
    Rigid3Manifold().Plus(from.params.data(), step.d.data(), best.params.data());
  }
  if (misfit - step.misfit <= min_parts * limit) return std::nullopt;
  return MakeConsensus(grid, data, votes, step.d, limit, best);
}

}  // namespace msc_vo
