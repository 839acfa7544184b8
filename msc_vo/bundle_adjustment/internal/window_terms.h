// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/window_state.h"
#include "msc_vo/bundle_adjustment/internal/window_validation.h"
#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/factors/depth_reprojection.h"
#include "msc_vo/factors/line_endpoint_prior.h"
#include "msc_vo/factors/manhattan_axis_alignment.h"
#include "msc_vo/factors/parallel_lines.h"
#include "msc_vo/factors/perpendicular_lines.h"
#include "msc_vo/factors/point_reprojection.h"
#include "msc_vo/factors/pose_prior.h"

namespace msc_vo {

// Which factors of every observation take part.
struct WindowInlierMask {
  std::vector<InlierMask> points;  // one per point observation
  std::vector<InlierMask> lines;   // one per line observation
  // Whether they may take part: false once rejected.
  std::vector<bool> parallel;       // one per parallel pair
  std::vector<bool> perpendicular;  // one per perpendicular pair
  std::vector<bool> alignments;     // one per axis alignment
};

// Huber's loss rho(s) of a squared norm s, and its derivative, as ceres::HuberLoss has them.
struct HuberLoss {
  double threshold = 0.0;  // sigmas; 0: squares

  double Cost(double s) const {
    if (threshold == 0.0 || s <= threshold * threshold) return s;
    return 2.0 * threshold * std::sqrt(s) - threshold * threshold;
  }
  double Weight(double s) const {
    return threshold == 0.0 || s <= threshold * threshold ? 1.0 : threshold / std::sqrt(s);
  }
};

// All factors of one kind that take part in the window's sum, in the order of the data.
template <typename FactorType>
struct WindowTerm {
  using Factor = FactorType;
  struct Block {
    Factor factor;
    // Positions in the state of what the factor is about, in its order: keyframe and landmark, two
    // lines, one line or one keyframe (second: -1).
    int first;
    int second;
    int source;     // position in WindowData of its observation, pair, alignment or prior; of an
                    // anchor: the line's
    int count = 1;  // so many identical terms
  };
  HuberLoss loss;
  std::vector<Block> blocks;
};

// The sum of factors of a window:
//
//   sum rho(|PointReprojection|^2) + rho(|DepthReprojection|^2) + rho(|LineReprojection|^2)
//     + rho(|LineDepthReprojection|^2) + |LineEndpointPrior|^2 + n rho(|ParallelLines|^2)
//     + n rho(|PerpendicularLines|^2) + rho(|ManhattanAxisAlignment|^2) + |PosePrior|^2
//
// (paper: Local Map Optimization; n: keyframes that see both lines). Plain values: what minimises
// it, CeresBackend or SchurWindow, is told by the options.
struct WindowTerms {
  WindowTerm<PointReprojection> point_reprojection;
  WindowTerm<DepthReprojection> point_depth;
  WindowTerm<LineReprojection> line_reprojection;
  WindowTerm<LineDepthReprojection> line_depth;
  WindowTerm<LineEndpointPrior> line_endpoint_prior;
  WindowTerm<ParallelLines> parallel;
  WindowTerm<PerpendicularLines> perpendicular;
  WindowTerm<ManhattanAxisAlignment> manhattan;
  WindowTerm<PosePrior> pose_prior;

  // Of every keyframe: whether an observation or a prior takes part. Of every point and line:
  // whether an observation does.
  std::vector<bool> keyframe_takes_part, point_observed, line_observed;
};

// The terms of the active observations, pairs and alignments. Sigmas of lines are those at `state`,
// anchors those of `data`.
WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state);

// Half the sum of robustified squares over all terms; not finite where one is not defined.
double Cost(const WindowTerms& terms, const WindowState& state);

// The parameter blocks of a block of a term.
template <typename Factor>
constexpr bool kSeesPoint = Factor::kBlockSizes.size() == 2 && Factor::kBlockSizes[1] == 3;

template <typename Factor, typename State, typename Block>
auto ParametersOf(State* state, const Block& block) {
  using Number = decltype(state->PoseBlock(0));
  if constexpr (Factor::kBlockSizes.size() == 1 && Factor::kBlockSizes[0] == 7) {
    return std::array<Number, 1>{state->PoseBlock(block.first)};
  } else if constexpr (Factor::kBlockSizes.size() == 1) {
    return std::array<Number, 1>{state->LineBlock(block.first)};
  } else if constexpr (Factor::kBlockSizes[0] == 7) {
    return std::array<Number, 2>{
        state->PoseBlock(block.first),
        kSeesPoint<Factor> ? state->PointBlock(block.second) : state->LineBlock(block.second)};
  } else {
    return std::array<Number, 2>{state->LineBlock(block.first), state->LineBlock(block.second)};
  }
}

// Squared norm of a block's residual in sigmas, before the loss; NaN where it is not defined.
template <typename Factor>
double ChiSquare(const typename WindowTerm<Factor>::Block& block, const WindowState& state) {
  Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
  const auto parameters = ParametersOf<Factor>(&state, block);
  bool defined;
  if constexpr (parameters.size() == 1) {
    defined = block.factor(parameters[0], r.data());
  } else {
    defined = block.factor(parameters[0], parameters[1], r.data());
  }
  return defined ? r.squaredNorm() : std::nan("");
}

// Half the sum of robustified squares, identical terms as often as they count.
template <typename Factor>
double Cost(const WindowTerm<Factor>& term, const WindowState& state) {
  double cost = 0.0;
  for (const auto& block : term.blocks) {
    cost += 0.5 * (block.count * term.loss.Cost(ChiSquare<Factor>(block, state)));
  }
  return cost;
}

}  // namespace msc_vo
