// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

/// LocalBundleAdjustment() in slices, for a caller that has other work between them. The result is
/// the same, bit by bit.
class StepwiseBundleAdjustment {
 public:
  /// `data` must outlive the object and must not change until the last slice, which writes the
  /// result into it.
  StepwiseBundleAdjustment(const BundleAdjustmentOptions& options, WindowData* data,
                           const WindowStageObserver& enter_stage = {});
  ~StepwiseBundleAdjustment();

  /// Runs the next slice: the checks, the construction of the factors of a solve, the computation
  /// of one step, one evaluation of the factors, the outlier test, or the output. The whole
  /// minimisation is one slice with a Ceres solver. Returns whether slices are left. Throws what
  /// LocalBundleAdjustment() throws; the object can then only be destroyed.
  bool Advance();

  /// Complete when Advance() has returned false.
  const BundleAdjustmentSummary& summary() const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace msc_vo
