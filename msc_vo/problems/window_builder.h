// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <memory>
#include <vector>

#include <ceres/loss_function.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>

#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/problems/observation.h"
#include "msc_vo/problems/window_state.h"
#include "msc_vo/problems/window_validation.h"

namespace msc_vo {

// The residual blocks of one kind of term.
struct WindowTerm {
  struct Block {
    const ceres::CostFunction* cost;    // owned by the problem
    std::array<double*, 2> parameters;  // the second is null for a block of one landmark alone
    int source;     // position in WindowData of its observation, pair or alignment; of an anchor:
                    // the line's
    int count = 1;  // so many identical terms
  };
  std::unique_ptr<ceres::LossFunction> loss;  // null: squares
  std::vector<Block> blocks;

  // Squared norm of every block's residual in sigmas, before the loss, at the present values.
  std::vector<double> ChiSquares() const;
  // Half the sum of robustified squares, identical terms as often as they count.
  double Cost() const;
};

// Which factors of every observation take part.
struct WindowActivity {
  std::vector<Activity> points;  // one per point observation
  std::vector<Activity> lines;   // one per line observation
  // Whether they may take part: false once rejected.
  std::vector<bool> parallel;       // one per parallel pair
  std::vector<bool> perpendicular;  // one per perpendicular pair
  std::vector<bool> alignments;     // one per axis alignment
};

// The sum of factors of a window as a Ceres problem over the numbers in `state`:
//
//   sum rho(|PointReprojection|^2) + rho(|DepthReprojection|^2) + rho(|LineReprojection|^2)
//     + rho(|LineDepthReprojection|^2) + |LineAnchor|^2 + n rho(|ParallelLines|^2)
//     + n rho(|PerpendicularLines|^2) + rho(|ManhattanAxisAlignment|^2)
//
// (paper: Local Map Optimization; n: keyframes that see both lines). All arguments must outlive the
// builder.
class WindowBuilder {
 public:
  WindowBuilder(const WindowOptions& options, const WindowData& data, const WindowIndex& index,
                const WindowActivity& activity, WindowState* state);

  ceres::Problem* problem() { return &problem_; }
  // Landmarks are eliminated first (group 0), then poses (group 1): the Schur complement. Lines of
  // one pair cannot both be in group 0; so many stay in group 1, see LinesToKeep.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const;

  WindowTerm point_reprojection, point_depth, line_reprojection, line_depth, line_anchor;
  WindowTerm parallel, perpendicular, manhattan;

 private:
  void AddPointReprojections();
  void AddPointDepths();
  void AddLineReprojections();
  void AddLineDepths();
  void AddLineAnchors();
  void AddParallelPairs();
  void AddPerpendicularPairs();
  void AddAxisAlignments();
  void HoldGauge();

  template <typename Factor>
  void AddBlock(const Factor& factor, double* pose, double* landmark, int observation,
                WindowTerm* term);
  template <typename Factor>
  void AddPairs(const TermOptions& options, const std::vector<WindowData::LinePair>& pairs,
                const std::vector<WindowIndex::Pair>& lines, const std::vector<bool>& active,
                WindowTerm* term);
  ceres::LossFunction* CountedLoss(const WindowTerm& term, int count);
  bool IsFree(int line) const;
  std::vector<bool> LinesToKeep() const;
  LineSegment3 LineInCamera(const WindowIndex::Link& link) const;

  const WindowOptions& options_;
  const WindowData& data_;
  const WindowIndex& index_;
  const WindowActivity& activity_;
  WindowState* state_;
  Rigid3Manifold pose_manifold_;
  std::vector<std::unique_ptr<ceres::LossFunction>> counted_losses_;
  ceres::Problem problem_;  // last: it goes before what it points to
};

}  // namespace msc_vo
