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
    int observation;                    // its position in WindowData; of an anchor: the line's
  };
  std::unique_ptr<ceres::LossFunction> loss;  // null: squares
  std::vector<Block> blocks;

  // Squared norm of every block's residual in sigmas, before the loss, at the present values.
  std::vector<double> ChiSquares() const;
  // Half the sum of robustified squares.
  double Cost() const;
};

// Which factors of every observation take part.
struct WindowActivity {
  std::vector<Activity> points;  // one per point observation
  std::vector<Activity> lines;   // one per line observation
};

// The sum of factors of a window as a Ceres problem over the numbers in `state`:
//
//   sum rho(|PointReprojection|^2) + rho(|DepthReprojection|^2) + rho(|LineReprojection|^2)
//     + rho(|LineDepthReprojection|^2) + |LineAnchor|^2
//
// (paper: Local Map Optimization, without the structural terms). `initial` holds the lines'
// anchors. All arguments must outlive the builder.
class WindowBuilder {
 public:
  WindowBuilder(const WindowOptions& options, const WindowData& data, const WindowIndex& index,
                const WindowActivity& activity, WindowState* state);

  ceres::Problem* problem() { return &problem_; }
  // Landmarks are eliminated first (group 0), then poses (group 1): the Schur complement.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrdering() const;

  WindowTerm point_reprojection, point_depth, line_reprojection, line_depth, line_anchor;

 private:
  void AddPointReprojections();
  void AddPointDepths();
  void AddLineReprojections();
  void AddLineDepths();
  void AddLineAnchors();
  void HoldGauge();

  template <typename Factor>
  void AddBlock(const Factor& factor, double* pose, double* landmark, int observation,
                WindowTerm* term);
  LineSegment3 LineInCamera(const WindowIndex::Link& link) const;

  const WindowOptions& options_;
  const WindowData& data_;
  const WindowIndex& index_;
  const WindowActivity& activity_;
  WindowState* state_;
  Rigid3Manifold pose_manifold_;
  ceres::Problem problem_;  // last: it goes before what it points to
};

}  // namespace msc_vo
