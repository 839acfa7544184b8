// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/cell_consensus.h"

#include <algorithm>
#include <array>
#include <utility>

#include <Eigen/Cholesky>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/pose_estimation/image_grid.h"
#include "msc_vo/pose_estimation/pose_matches.h"

namespace msc_vo {

namespace {

// Cells of the image; 53 pixels wide and high at 640x480. Chosen by measurement, see
// docs/lab/dynamic_objects.md.
constexpr int kColumns = 12;
constexpr int kRows = 9;
// Squared sigmas above which a cell contradicts a pose: the 99.9 % quantile of chi-square with six
// degrees of freedom, because the cell's own best pose absorbs six. The sigmas are inflated for it,
// see PoseOptions::max_frame_noise.
constexpr double kRejectChiSquare = 22.458;
// Weight of a cell without matches that are confirmed static, relative to one with confirmed
// matches only. Landmarks of a dynamic object are rarely confirmed. The whole grid weighs as much
// as one confirmed cell: unconfirmed landmarks cannot outvote one confirmed cell.
constexpr double kUnconfirmedWeight = 0.01;
// Cells by which another pose must be better to replace the estimate. Chosen by measurement, see
// docs/lab/dynamic_objects.md.
constexpr double kMinCells = 1.0;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// The cells that the matches of a kind belong to.
struct MatchCells {
  std::vector<int> cells;    // of one match after the other
  std::vector<size_t> ends;  // one per match, of its part of `cells`
};

PerKind<MatchCells> FindCells(const ImageGrid& grid, const PoseData& data) {
  PerKind<MatchCells> found;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    MatchCells& of_kind = found.Of<L>();
    for (const auto& match : OfKind<L>(data)) {
      AppendCells(grid, match, &of_kind.cells);
      of_kind.ends.push_back(of_kind.cells.size());
    }
  });
  return found;
}

// The quadratic model of the cost of one cell's matches, as a function of a step d in the tangent
// of the pose that the matches were linearised at.
struct CellModel {
  double weight = 0.0;         // 1 if all matches are confirmed static; 0 without matches
  double num_matches = 0.0;    // a line that crosses n cells counts 1/n in each
  double num_confirmed = 0.0;  // matches with landmarks that are confirmed static
  NormalEquations equations;
  double own_decrease = 0.0;  // squared sigmas; decrease of the cost by the cell's own best step

  void Add(const NormalEquations& match, bool is_confirmed, double fraction) {
    equations.hessian += fraction * match.hessian;
    equations.gradient += fraction * match.gradient;
    num_matches += fraction;
    num_confirmed += is_confirmed ? fraction : 0.0;
  }
  // Squared sigmas by which the cost at d exceeds the cell's own minimum.
  double Misfit(const Vector6& d) const {
    return std::max(0.0, d.dot(equations.hessian * d + 2.0 * equations.gradient) + own_decrease);
  }
};

using CellModels = std::vector<CellModel>;  // by cell

// Decrease of the cost by the step that minimises it. The damping keeps directions that the cell
// does not constrain from contributing.
double OwnDecrease(const NormalEquations& equations) {
  Matrix6 damped = equations.hessian;
  damped.diagonal() *= 1.0 + 1e-6;
  damped.diagonal().array() += 1e-12 * equations.hessian.trace();
  return equations.gradient.dot(damped.ldlt().solve(equations.gradient));
}

// Models of all cells at `pose`. Outliers of the pose are included: they may belong to the static
// scene.
CellModels MakeModels(const PoseOptions& options, const PoseData& data, int num_cells,
                      const PerKind<MatchCells>& cells, const Rigid3& pose) {
  const PoseInlierMask in_front = AllInFront(options, data, pose);
  CellModels models(num_cells);
  PoseFactors match;
  SetLosses(options, &match);
  NormalEquations equations;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const auto& matches = OfKind<L>(data);
    const MatchCells& of_kind = cells.Of<L>();
    for (size_t i = 0; i < matches.size(); ++i) {
      match.Clear();
      AddFactors(options, data.camera, matches[i], in_front.Of<L>()[i], pose, &match);
      if (match.NumRows() == 0 || !match.Linearize(pose, &equations)) continue;
      const size_t begin = i == 0 ? 0 : of_kind.ends[i - 1], end = of_kind.ends[i];
      const double fraction = 1.0 / static_cast<double>(end - begin);
      for (size_t k = begin; k < end; ++k) {
        models[of_kind.cells[k]].Add(equations, matches[i].confirmed, fraction);
      }
    }
  });
  for (CellModel& model : models) {
    if (model.num_matches == 0.0) continue;
    const double confirmed = model.num_confirmed / model.num_matches;
    model.weight = confirmed + (1.0 - confirmed) * kUnconfirmedWeight;
    model.own_decrease = OwnDecrease(model.equations);
  }
  return models;
}

// A step and the misfits of the cells at it.
struct Step {
  Vector6 d;
  std::vector<double> misfits;  // squared sigmas, one per cell
};

Step MakeStep(const CellModels& models, const Vector6& d) {
  Step step{d, {}};
  step.misfits.reserve(models.size());
  for (const CellModel& model : models) step.misfits.push_back(model.Misfit(d));
  return step;
}

// The sum of the bounded misfits.
double Score(const CellModels& models, const Step& step, double limit) {
  double sum = 0.0;
  for (size_t i = 0; i < models.size(); ++i) {
    sum += models[i].weight * std::min(limit, step.misfits[i]);
  }
  return sum;
}

// Sum of the weights of the cells that contradict the step.
double ContradictingWeight(const CellModels& models, const Step& step, double limit) {
  double sum = 0.0;
  for (size_t i = 0; i < models.size(); ++i) {
    sum += step.misfits[i] > limit ? models[i].weight : 0.0;
  }
  return sum;
}

// Factor by which the squared sigmas are too small for the cells: the median misfit relative to
// that of chi-square with six degrees of freedom, at least 1. Dynamic cells with less than half of
// the weight cannot make it arbitrarily large. Cells with fewer than two matches are left out,
// because these have fewer degrees of freedom.
double VarianceInflation(const CellModels& models, const Step& step) {
  constexpr double kMedianChi2 = 5.348;
  std::vector<std::pair<double, double>> misfits;  // misfit, weight
  double total = 0.0;
  for (size_t i = 0; i < models.size(); ++i) {
    if (models[i].num_matches < 2.0) continue;
    misfits.emplace_back(step.misfits[i], models[i].weight);
    total += models[i].weight;
  }
  std::sort(misfits.begin(), misfits.end());
  double sum = 0.0;
  for (const auto& [misfit, weight] : misfits) {
    sum += weight;
    if (2.0 * sum >= total) return std::max(1.0, misfit / kMedianChi2);
  }
  return 1.0;
}

// Minimum of the weighted sum of the cells' models. A small multiple of the sum of all hessians
// holds the directions that the weighted cells do not constrain.
template <typename Weight>
Vector6 WeightedMinimum(const CellModels& models, const Matrix6& all, const Weight& weight) {
  Matrix6 hessian = 1e-4 * all;
  Vector6 gradient = Vector6::Zero();
  for (size_t cell = 0; cell < models.size(); ++cell) {
    const double w = weight(static_cast<int>(cell));
    if (w == 0.0) continue;
    hessian += w * models[cell].equations.hessian;
    gradient += w * models[cell].equations.gradient;
  }
  return -hessian.ldlt().solve(gradient);
}

// A rectangle in fractions of the image's width and height.
struct Region {
  double left, top, right, bottom;
  bool Contains(const Eigen::Vector2d& x) const {
    return x.x() > left && x.x() < right && x.y() > top && x.y() < bottom;
  }
};
constexpr Region Columns(double left, double right) { return {left, 0.0, right, 1.0}; }
constexpr Region Rows(double top, double bottom) { return {0.0, top, 1.0, bottom}; }

// Starts of the search: the best step of each region. A dynamic object that covers less than half
// of the image leaves one of the regions free. Regions of one size do not overlap, because one row
// of cells on the object spoils a region's step.
constexpr double kThird = 1.0 / 3.0;
constexpr std::array<Region, 10> kStartRegions{Columns(0.0, 1.0),
                                               Columns(0.0, 0.5),
                                               Columns(0.5, 1.0),
                                               Rows(0.0, 0.5),
                                               Rows(0.5, 1.0),
                                               Columns(0.0, kThird),
                                               Columns(kThird, 1.0 - kThird),
                                               Columns(1.0 - kThird, 1.0),
                                               Rows(0.0, kThird),
                                               Rows(1.0 - kThird, 1.0)};

// Iterations of reweighted least squares (Geman-McClure) from each start; fewer if one of them
// decreases the score by less than kMinDecrease.
constexpr int kMaxReweightings = 5;
constexpr double kMinDecrease = 0.01;

// The zero step, and all that the search visits from each start.
std::vector<Step> TrySteps(const ImageGrid& grid, const CellModels& models, double limit) {
  std::vector<Step> steps{MakeStep(models, Vector6::Zero())};
  Matrix6 all = Matrix6::Zero();
  for (const CellModel& model : models) all += model.equations.hessian;
  for (const Region& region : kStartRegions) {
    Vector6 d = WeightedMinimum(
        models, all, [&](int cell) { return region.Contains(grid.CenterOf(cell)) ? 1.0 : 0.0; });
    double last_score = 0.0;
    for (int i = 0; i < kMaxReweightings; ++i) {
      steps.push_back(MakeStep(models, d));
      const Step& step = steps.back();
      const double score = Score(models, step, limit);
      if (i > 0 && score > (1.0 - kMinDecrease) * last_score) break;
      last_score = score;
      d = WeightedMinimum(models, all, [&](int cell) {
        const double w = limit / (limit + step.misfits[cell]);
        return models[cell].weight * w * w;
      });
    }
  }
  return steps;
}

}  // namespace

ImageGrid ConsensusGrid(const PinholeCamera& camera) { return {kColumns, kRows, camera}; }

std::optional<CellConsensus> FindCellConsensus(const PoseOptions& options, const PoseData& data,
                                               const Rigid3& pose) {
  constexpr int kRounds = 3;  // of linearisation
  double limit = kRejectChiSquare;
  const ImageGrid grid = ConsensusGrid(data.camera);
  const PerKind<MatchCells> cells = FindCells(grid, data);
  CellModels models = MakeModels(options, data, grid.size(), cells, pose);
  const Step given = MakeStep(models, Vector6::Zero());
  // A search is pointless if fewer cells contradict the pose, even with the sigmas as they are,
  // than another pose must win.
  if (ContradictingWeight(models, given, limit) <= kMinCells) return std::nullopt;
  const CellModels given_models = models;
  double inflation = options.max_frame_noise * options.max_frame_noise;
  Rigid3 best = pose;
  Step step;
  for (int round = 0; round < kRounds; ++round) {
    if (round > 0) models = MakeModels(options, data, grid.size(), cells, best);
    const std::vector<Step> steps = TrySteps(grid, models, limit);
    // The pose of the static scene needs the least inflation.
    for (size_t i = 0; i < steps.size() && inflation > 1.0; ++i) {
      inflation = std::min(inflation, VarianceInflation(models, steps[i]));
    }
    limit = inflation * kRejectChiSquare;
    step = *std::min_element(steps.begin(), steps.end(), [&](const Step& a, const Step& b) {
      return Score(models, a, limit) < Score(models, b, limit);
    });
    const double gain = Score(given_models, given, limit) - Score(models, step, limit);
    // Half of the required improvement is enough to go on: relinearisation may yield the rest.
    const double required = round + 1 < kRounds ? 0.5 * kMinCells : kMinCells;
    if (!(gain > required * limit)) return std::nullopt;
    const Rigid3 from = best;
    Rigid3Manifold().Plus(from.params.data(), step.d.data(), best.params.data());
  }
  CellConsensus consensus{best, {}};
  for (const double misfit : step.misfits) consensus.dynamic_cells.push_back(misfit > limit);
  return consensus;
}

}  // namespace msc_vo
