// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/custom_term.h"
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
#include "msc_vo/factors/robust_loss.h"

namespace msc_vo {

/// Inliers among the measurements of a window.
struct WindowInlierMask {
  std::vector<InlierMask> points;   ///< One per point observation.
  std::vector<InlierMask> lines;    ///< One per line observation.
  std::vector<bool> parallel;       ///< One per parallel pair.
  std::vector<bool> perpendicular;  ///< One per perpendicular pair.
  std::vector<bool> alignments;     ///< One per axis alignment.
};

/// All residual blocks of one factor type, in the order of the data.
template <typename FactorType>
struct WindowTerm {
  using Factor = FactorType;
  struct Block {
    Factor factor;
    /// Positions in the state of the parameter blocks, in the factor's order: keyframe and
    /// landmark, two lines, or one line or keyframe (second: -1).
    int first;
    int second;
    /// Position in WindowData of the observation, pair, alignment or pose prior, or of the line for
    /// endpoint priors.
    int source;
    int count = 1;  ///< Multiplicity.
  };
  HuberLoss loss;
  std::vector<Block> blocks;
};

/// Cost function of local bundle adjustment (paper: Local Map Optimization):
///
///   1/2 sum rho(|PointReprojection|^2) + rho(|DepthReprojection|^2) + rho(|LineReprojection|^2)
///     + rho(|LineDepthReprojection|^2) + |LineEndpointPrior|^2 + n rho(|ParallelLines|^2)
///     + n rho(|PerpendicularLines|^2) + rho(|ManhattanAxisAlignment|^2) + |PosePrior|^2
///     + rho(|CustomFactor|^2)
///
/// with n the multiplicity of a pair (WindowData::LinePair). It holds values, except that custom
/// factors are those of the data, and is minimised by CeresBackend or MinimizeWithBlockSchur.
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
  CustomTerm custom;

  /// One per keyframe: whether an observation, a pose prior or a custom factor has a residual
  /// block.
  std::vector<bool> keyframe_constrained;
  /// One per point or line: whether an observation or a custom factor has a residual block.
  std::vector<bool> point_constrained, line_constrained;
  /// One per extra block: whether a custom factor has it.
  std::vector<bool> extra_constrained;
};

/// Builds the terms of the inliers. The sigmas of line factors are those at `state`; the endpoint
/// priors are centred at the lines of `data`.
WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state);

/// Cost of all terms; NaN where a factor is undefined.
double Cost(const WindowTerms& terms, const WindowState& state);

/// Whether a factor with two parameter blocks depends on a point, not on a line.
template <typename Factor>
constexpr bool kObservesPoint = Factor::kBlockSizes.size() == 2 && Factor::kBlockSizes[1] == 3;

/// Pointers to the parameter blocks of a residual block, in the factor's order.
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
        kObservesPoint<Factor> ? state->PointBlock(block.second) : state->LineBlock(block.second)};
  } else {
    return std::array<Number, 2>{state->LineBlock(block.first), state->LineBlock(block.second)};
  }
}

/// Squared norm of a whitened residual before the loss; NaN where the factor is undefined.
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

/// Half the sum of robust squared norms, with multiplicities.
template <typename Factor>
double Cost(const WindowTerm<Factor>& term, const WindowState& state) {
  double cost = 0.0;
  for (const auto& block : term.blocks) {
    cost += 0.5 * (block.count * term.loss.Cost(ChiSquare<Factor>(block, state)));
  }
  return cost;
}

}  // namespace msc_vo
