// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/stepwise_bundle_adjustment.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/landmark_consensus.h"
#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"
#include "msc_vo/bundle_adjustment/internal/window_validation.h"
#include "msc_vo/bundle_adjustment/window_covariance.h"

namespace msc_vo {

namespace {

// Writes the cost of every term to `member` of its summary. Returns the sum.
double WriteCosts(const WindowTerms& terms, const WindowState& state, double TermSummary::*member,
                  BundleAdjustmentSummary* summary) {
  double sum = 0.0;
  ForEachTerm(terms, [&](const auto& term, const auto& of_term) {
    (summary->*term.summary).*member = Cost(of_term, state);
    sum += (summary->*term.summary).*member;
  });
  return sum;
}

void WriteCounts(const WindowTerms& terms, BundleAdjustmentSummary* summary) {
  ForEachTerm(terms, [summary](const auto& term, const auto& of_term) {
    (summary->*term.summary).num_residual_blocks = static_cast<int>(of_term.blocks.size());
  });
}

// Searches after the second solve, which all but the last one repeat it after. More of them change
// few marks, see docs/lab/bundle_adjustment.md.
constexpr int kMaxSearches = 3;

void CountRejected(const std::vector<InlierMask>& before, const std::vector<InlierMask>& after,
                   TermSummary* reprojection, TermSummary* depth) {
  reprojection->num_rejected = depth->num_rejected = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    reprojection->num_rejected += before[i].reprojection && !after[i].reprojection;
    depth->num_rejected += before[i].depth && after[i].reprojection && !after[i].depth;
  }
}

template <typename Item>
std::vector<int64_t> IdsOf(const std::vector<Item>& items) {
  std::vector<int64_t> ids;
  for (const Item& item : items) ids.push_back(item.id);
  return ids;
}

template <typename Matrix>
std::vector<int64_t> Undetermined(const std::vector<int64_t>& ids,
                                  const std::vector<std::optional<Matrix>>& covariances) {
  std::vector<int64_t> undetermined;
  for (size_t i = 0; i < ids.size(); ++i) {
    if (!covariances[i]) undetermined.push_back(ids[i]);
  }
  return undetermined;
}

template <typename Observation>
void WriteMarks(const std::vector<InlierMask>& first, const std::vector<InlierMask>& last,
                std::vector<Observation>* observations) {
  for (size_t i = 0; i < last.size(); ++i) {
    (*observations)[i].rejected = !last[i].reprojection;
    (*observations)[i].depth_rejected = last[i].reprojection && first[i].depth && !last[i].depth;
  }
}

// Writes the solution and the rejection marks. `first`: mask of the first solve. Keyframes and
// landmarks without residual blocks in the second solve keep their initial values.
void WriteBack(const WindowTerms& terms, const WindowInlierMask& first,
               const WindowInlierMask& inlier_mask, const WindowState& state, WindowData* data) {
  const auto is_constrained = [&terms](const StateBlock& block) {
    return terms.Constrained(block.kind)[block.position];
  };
  WriteState(state, is_constrained, data);
  WriteMarks(first.points, inlier_mask.points, &data->point_observations);
  WriteMarks(first.lines, inlier_mask.lines, &data->line_observations);
  ForEachRelation([&](const auto& term) {
    auto& records = data->*term.records;
    for (size_t i = 0; i < records.size(); ++i) {
      records[i].rejected = !(inlier_mask.*term.inliers)[i];
    }
  });
}

}  // namespace

class StepwiseBundleAdjustment::Solver {
 public:
  Solver(const BundleAdjustmentOptions& options, WindowData* data,
         const WindowStageObserver& enter_stage)
      : options_(options), data_(data), enter_stage_(enter_stage) {}

  bool Advance() {
    switch (phase_) {
      case Phase::kBegin:
        Begin();
        return GoTo(Phase::kFirstTerms);
      case Phase::kFirstTerms:
        BuildTerms(*data_);
        summary_.initial_cost = WriteCosts(terms_, *state_, &TermSummary::initial_cost, &summary_);
        StartMinimizer(options_.first_iterations);
        return GoTo(Phase::kFirstSolve);
      case Phase::kFirstSolve:
        if (Minimize()) return true;
        return GoTo(is_usable_ ? Phase::kRejection : Phase::kDone);
      case Phase::kRejection:
        RejectAndEstimateNoise();
        return GoTo(Phase::kSecondTerms);
      case Phase::kSecondTerms:
        BuildTerms(with_noise_);
        StartMinimizer(options_.second_iterations);
        return GoTo(Phase::kSecondSolve);
      case Phase::kSecondSolve:
        if (Minimize()) return true;
        if (!is_usable_) return GoTo(Phase::kDone);
        return GoTo(options_.consensus.enabled ? Phase::kSearch : Phase::kEnd);
      case Phase::kSearch:
        if (SearchOutliers()) return GoTo(Phase::kSecondTerms);
        ClassifyAtSolution();
        return GoTo(Phase::kEnd);
      case Phase::kEnd:
        End();
        break;
      case Phase::kDone:
        break;
    }
    return GoTo(Phase::kDone);
  }
  const BundleAdjustmentSummary& summary() const { return summary_; }

 private:
  enum class Phase {
    kBegin,
    kFirstTerms,
    kFirstSolve,
    kRejection,
    kSecondTerms,
    kSecondSolve,
    kSearch,
    kEnd,
    kDone,
  };

  bool GoTo(Phase phase) {
    phase_ = phase;
    return phase != Phase::kDone;
  }
  void Enter(WindowStage stage) const {
    if (enter_stage_) enter_stage_(stage);
  }

  void Begin() {
    Enter(WindowStage::kBuild);
    index_ = ValidateWindow(options_, *data_);
    inlier_mask_ = InitialInlierMask(options_, index_, *data_, &summary_.num_behind_camera);
    first_inlier_mask_ = inlier_mask_;
    state_.emplace(*data_);
  }

  void BuildTerms(const WindowData& data) {
    terms_ = MakeWindowTerms(options_, data, index_, inlier_mask_, *state_);
  }

  void RejectAndEstimateNoise() {
    RejectOutliers(options_, terms_, *state_, &inlier_mask_, &summary_);
    if (options_.consensus.enabled) {
      // Replaces the marks of observations, and keeps those of relations.
      FindConsensus(options_, index_, *data_, &*state_, &inlier_mask_);
    }
    // A copy: *data_ must stay unchanged if the second solve fails.
    with_noise_ = *data_;
    EstimateLandmarkNoise(options_.landmark_noise, index_, inlier_mask_, *state_, &with_noise_);
  }

  // Returns whether to solve again.
  bool SearchOutliers() {
    const WindowInlierMask before = inlier_mask_;
    FindConsensus(options_, index_, *data_, &*state_, &inlier_mask_);
    if (before.points == inlier_mask_.points && before.lines == inlier_mask_.lines) return false;
    return ++num_searches_ < kMaxSearches;
  }

  // Leaves no inlier beyond its limit at the solution. ListUndetermined finds what loses its
  // support.
  void ClassifyAtSolution() {
    EstimateLandmarkNoise(options_.landmark_noise, index_, inlier_mask_, *state_, &with_noise_);
    BuildTerms(with_noise_);
    // Relations are tested after the first solve only.
    WindowInlierMask tested = inlier_mask_;
    BundleAdjustmentSummary unused;
    RejectOutliers(options_, terms_, *state_, &tested, &unused);
    inlier_mask_.points = tested.points;
    inlier_mask_.lines = tested.lines;
    BuildTerms(with_noise_);
    CountRejected(first_inlier_mask_.points, inlier_mask_.points, &summary_.point_reprojection,
                  &summary_.point_depth);
    CountRejected(first_inlier_mask_.lines, inlier_mask_.lines, &summary_.line_reprojection,
                  &summary_.line_depth);
  }

  void StartMinimizer(int max_iterations) {
    max_iterations_ = max_iterations;
    if (options_.solver != BundleAdjustmentSolver::kBlockSchur) return;
    minimizer_.emplace(BlockStructure(*data_, terms_, *state_), terms_, max_iterations,
                       enter_stage_, &*state_);
  }

  // Returns true if the minimisation goes on; otherwise is_usable_ says whether it succeeded.
  bool Minimize() {
    if (minimizer_ && minimizer_->Advance()) return true;
    MinimizerReport report;
    if (minimizer_) {
      report = minimizer_->report();
      minimizer_.reset();
    } else {
      Enter(WindowStage::kStep);
      report = MinimizeWithCeres(options_, *data_, terms_, max_iterations_, &*state_);
    }
    Enter(WindowStage::kBuild);
    summary_.num_iterations += report.num_iterations;
    summary_.num_accepted += report.num_accepted;
    summary_.schur_structure = report.schur_structure;
    summary_.message = report.message;
    is_usable_ = report.usable && state_->AllFinite();
    return false;
  }

  void End() {
    WriteCounts(terms_, &summary_);
    summary_.final_cost = WriteCosts(terms_, *state_, &TermSummary::final_cost, &summary_);
    if (!std::isfinite(summary_.initial_cost) || !std::isfinite(summary_.final_cost)) {
      summary_.message = "the cost is not finite";
      return;
    }
    Enter(WindowStage::kWriteBack);
    if (!options_.consensus.enabled) {
      EstimateLandmarkNoise(options_.landmark_noise, index_, inlier_mask_, *state_, &with_noise_);
    }
    WriteBack(terms_, first_inlier_mask_, inlier_mask_, *state_, &with_noise_);
    // A result that a later bundle adjustment would refuse is none.
    summary_.usable = HasValidState(with_noise_, &summary_.message);
    if (summary_.usable && options_.consensus.enabled) ListUndetermined();
    if (summary_.usable) *data_ = std::move(with_noise_);
    Enter(WindowStage::kDone);
  }

  void ListUndetermined() {
    const CovarianceSelection all{IdsOf(with_noise_.keyframes), IdsOf(with_noise_.points),
                                  IdsOf(with_noise_.lines)};
    const WindowCovariance covariance = EstimateCovariance(options_, with_noise_, all);
    summary_.undetermined_keyframes = Undetermined(all.keyframes, covariance.keyframes);
    summary_.undetermined_points = Undetermined(all.points, covariance.points);
    summary_.undetermined_lines = Undetermined(all.lines, covariance.lines);
  }

  const BundleAdjustmentOptions options_;
  WindowData* data_;
  WindowData with_noise_;  // of the second solve
  const WindowStageObserver enter_stage_;
  Phase phase_ = Phase::kBegin;
  WindowIndex index_;
  WindowInlierMask first_inlier_mask_, inlier_mask_;
  int num_searches_ = 0;
  std::optional<WindowState> state_;
  WindowTerms terms_;                             // of the present solve
  std::optional<BlockSchurMinimizer> minimizer_;  // of the present solve, unless it is one of Ceres
  int max_iterations_ = 0;
  bool is_usable_ = false;  // the last solve succeeded
  BundleAdjustmentSummary summary_;
};

StepwiseBundleAdjustment::StepwiseBundleAdjustment(const BundleAdjustmentOptions& options,
                                                   WindowData* data,
                                                   const WindowStageObserver& enter_stage)
    : solver_(std::make_unique<Solver>(options, data, enter_stage)) {}

StepwiseBundleAdjustment::~StepwiseBundleAdjustment() = default;

bool StepwiseBundleAdjustment::Advance() { return solver_->Advance(); }

const BundleAdjustmentSummary& StepwiseBundleAdjustment::summary() const {
  return solver_->summary();
}

}  // namespace msc_vo
