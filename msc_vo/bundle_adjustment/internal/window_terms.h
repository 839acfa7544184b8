// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/custom_linearization.h"
#include "msc_vo/bundle_adjustment/internal/term_list.h"
#include "msc_vo/factors/robust_loss.h"

namespace msc_vo {

/// The residual blocks of a term, in the order of the data.
template <typename Factor>
struct WindowTerm {
  struct Block {
    Factor factor;
    /// Positions in the state of the parameter blocks, whose kinds are those of the factor.
    std::array<int, Factor::kBlockKinds.size()> parameters;
    /// Position in WindowData of the observation, relation or pose prior, or of the line for
    /// endpoint priors.
    int source;
    int count = 1;  ///< Multiplicity.
  };
  HuberLoss loss;
  std::vector<Block> blocks;
};
template <>
struct WindowTerm<CustomFactor> {
  struct Block {
    const CustomFactor* factor = nullptr;
    std::vector<StateBlock> parameters;  ///< In the order of the cost function.
  };
  std::vector<Block> blocks;
};

/// One WindowTerm per entry of a list of terms.
template <typename... Terms>
std::tuple<WindowTerm<typename Terms::Factor>...> BlocksOf(const std::tuple<Terms...>&);

/// Cost function of local bundle adjustment (paper: Local Map Optimization):
///
///   1/2 sum rho(|PointReprojection|^2) + rho(|DepthReprojection|^2) + rho(|LineReprojection|^2)
///     + rho(|LineDepthReprojection|^2) + |LineEndpointPrior|^2 + rho(|ManhattanAxisAlignment|^2)
///     + n rho(|ParallelLines|^2) + n rho(|PerpendicularLines|^2) + |PosePrior|^2
///     + rho(|CustomFactor|^2)
///
/// with n the multiplicity of a pair (WindowData::LinePair). It holds values, except that custom
/// factors are those of the data, and is minimised by WindowProblem or BlockSchurMinimizer.
struct WindowTerms {
  decltype(BlocksOf(kTerms)) all;

  /// The residual blocks of a factor.
  template <typename Factor>
  WindowTerm<Factor>& Of() {
    return std::get<WindowTerm<Factor>>(all);
  }
  template <typename Factor>
  const WindowTerm<Factor>& Of() const {
    return std::get<WindowTerm<Factor>>(all);
  }

  /// One per keyframe: whether an observation, a pose prior or a custom factor has a residual
  /// block.
  std::vector<bool> keyframe_constrained;
  /// One per point or line: whether an observation or a custom factor has a residual block. Lines
  /// that are fixed count as constrained.
  std::vector<bool> point_constrained, line_constrained;
  /// One per extra block: whether a custom factor has it.
  std::vector<bool> extra_constrained;
  /// The flags of a kind of StateBlock.
  std::vector<bool>& Constrained(BlockKind kind);
  const std::vector<bool>& Constrained(BlockKind kind) const {
    return const_cast<WindowTerms*>(this)->Constrained(kind);
  }
};

/// Calls visit(term, blocks of the term) for every term.
template <typename Visitor>
void ForEachTerm(const WindowTerms& terms, const Visitor& visit) {
  ForEachTerm([&](const auto& term) {
    visit(term, terms.Of<typename std::decay_t<decltype(term)>::Factor>());
  });
}

/// Number of lines among the parameter blocks of a factor.
template <typename Factor>
constexpr int NumLines() {
  int count = 0;
  for (const BlockKind kind : Factor::kBlockKinds) count += kind == BlockKind::kLine ? 1 : 0;
  return count;
}
/// Whether a factor couples two lines.
template <typename Factor>
constexpr bool kRelatesLines = NumLines<Factor>() == 2;
template <>
inline constexpr bool kRelatesLines<CustomFactor> = false;

/// Calls visit(a, b) for every residual block between two lines.
template <typename Visitor>
void ForEachPair(const WindowTerms& terms, const Visitor& visit) {
  ForEachTerm(terms, [&visit](const auto& term, const auto& of_term) {
    if constexpr (kRelatesLines<typename std::decay_t<decltype(term)>::Factor>) {
      for (const auto& block : of_term.blocks) visit(block.parameters[0], block.parameters[1]);
    }
  });
}

/// Builds the terms of the inliers. The sigmas of line factors are those at `state`; the endpoint
/// priors are centred at the lines of `data`.
WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state);

/// Cost of all terms; NaN where a factor is undefined.
double Cost(const WindowTerms& terms, const WindowState& state);

/// Pointer to parameter block `position` of a kind.
template <BlockKind Kind, typename State>
auto BlockOf(State* state, int position) {
  if constexpr (Kind == BlockKind::kPose) return state->PoseBlock(position);
  if constexpr (Kind == BlockKind::kPoint) return state->PointBlock(position);
  if constexpr (Kind == BlockKind::kLine) return state->LineBlock(position);
}

/// Pointers to the parameter blocks of a residual block, in the factor's order.
template <typename Factor, typename State, size_t... I>
auto ParametersOf(State* state, const std::array<int, sizeof...(I)>& positions,
                  std::index_sequence<I...>) {
  return std::array{BlockOf<Factor::kBlockKinds[I]>(state, positions[I])...};
}
template <typename Factor, typename State>
auto ParametersOf(State* state, const typename WindowTerm<Factor>::Block& block) {
  return ParametersOf<Factor>(state, block.parameters,
                              std::make_index_sequence<Factor::kBlockKinds.size()>());
}
/// The parameter blocks of a custom factor, all of them variable. They point into `state`.
std::vector<CustomParameter> ParametersOf(const WindowTerm<CustomFactor>::Block& block,
                                          const WindowState& state);

/// Squared norm of a whitened residual before the loss; NaN where the factor is undefined.
template <typename Factor>
double ChiSquare(const typename WindowTerm<Factor>::Block& block, const WindowState& state) {
  Eigen::Matrix<double, Factor::kNumResiduals, 1> r;
  const bool defined =
      std::apply([&](const auto*... parameters) { return block.factor(parameters..., r.data()); },
                 ParametersOf<Factor>(&state, block));
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
double Cost(const WindowTerm<CustomFactor>& term, const WindowState& state);

}  // namespace msc_vo
