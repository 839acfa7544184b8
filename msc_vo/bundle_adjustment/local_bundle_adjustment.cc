// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/landmark_noise.h"
#include "msc_vo/bundle_adjustment/internal/window_validation.h"
#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/text/format_text.h"

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

// Writes the solution and the rejection marks. Keyframes and landmarks without residual blocks in
// the second solve keep their initial values.
void WriteBack(const WindowTerms& terms, const WindowInlierMask& inlier_mask,
               const WindowState& state, WindowData* data) {
  const auto is_constrained = [&terms](const StateBlock& block) {
    return terms.Constrained(block.kind)[block.position];
  };
  WriteState(state, is_constrained, data);
  for (size_t i = 0; i < inlier_mask.points.size(); ++i) {
    data->point_observations[i].rejected = !inlier_mask.points[i].reprojection;
  }
  for (size_t i = 0; i < inlier_mask.lines.size(); ++i) {
    data->line_observations[i].rejected = !inlier_mask.lines[i].reprojection;
  }
  ForEachRelation([&](const auto& term) {
    auto& records = data->*term.records;
    for (size_t i = 0; i < records.size(); ++i) {
      records[i].rejected = !(inlier_mask.*term.inliers)[i];
    }
  });
}

MinimizerReport Minimize(const BundleAdjustmentOptions& options, const WindowData& data,
                         const WindowTerms& terms, int max_iterations,
                         const WindowStageObserver& enter_stage, WindowState* state) {
  if (options.solver == BundleAdjustmentSolver::kBlockSchur) {
    return MinimizeWithBlockSchur(BlockStructure(data, terms, *state), terms, max_iterations,
                                  enter_stage, state);
  }
  if (enter_stage) enter_stage(WindowStage::kStep);
  return MinimizeWithCeres(options, data, terms, max_iterations, state);
}

}  // namespace

BundleAdjustmentSummary LocalBundleAdjustment(const BundleAdjustmentOptions& options,
                                              WindowData* data,
                                              const WindowStageObserver& enter_stage) {
  const auto enter = [&enter_stage](WindowStage stage) {
    if (enter_stage) enter_stage(stage);
  };
  enter(WindowStage::kBuild);
  const WindowIndex index = ValidateWindow(options, *data);
  BundleAdjustmentSummary summary;
  WindowInlierMask inlier_mask =
      InitialInlierMask(options, index, *data, &summary.num_behind_camera);
  WindowState state(*data);

  const auto minimize = [&](const WindowTerms& terms, int iterations) {
    const MinimizerReport report = Minimize(options, *data, terms, iterations, enter_stage, &state);
    enter(WindowStage::kBuild);
    summary.num_iterations += report.num_iterations;
    summary.num_accepted += report.num_accepted;
    summary.schur_structure = report.schur_structure;
    summary.message = report.message;
    return report.usable && state.AllFinite();
  };

  const WindowTerms first = MakeWindowTerms(options, *data, index, inlier_mask, state);
  summary.initial_cost = WriteCosts(first, state, &TermSummary::initial_cost, &summary);
  if (!minimize(first, options.first_iterations)) return summary;
  RejectOutliers(options, first, state, &inlier_mask, &summary);

  // A copy: *data must stay unchanged if the second solve fails.
  WindowData with_noise = *data;
  EstimateLandmarkNoise(options.landmark_noise, index, inlier_mask, state, &with_noise);
  const WindowTerms second = MakeWindowTerms(options, with_noise, index, inlier_mask, state);
  if (!minimize(second, options.second_iterations)) return summary;
  WriteCounts(second, &summary);
  summary.final_cost = WriteCosts(second, state, &TermSummary::final_cost, &summary);
  if (!std::isfinite(summary.initial_cost) || !std::isfinite(summary.final_cost)) {
    summary.message = "the cost is not finite";
    return summary;
  }
  enter(WindowStage::kWriteBack);
  EstimateLandmarkNoise(options.landmark_noise, index, inlier_mask, state, &with_noise);
  WriteBack(second, inlier_mask, state, &with_noise);
  // A result that a later bundle adjustment would refuse is none.
  summary.usable = HasValidState(with_noise, &summary.message);
  if (summary.usable) *data = std::move(with_noise);
  enter(WindowStage::kDone);
  return summary;
}

bool BundleAdjustmentOptions::IsValid(std::string* error) const {
  if (!CommonOptionsAreValid(*this, error)) return false;
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(parallel.huber) || !is_positive(perpendicular.huber) ||
      !is_positive(manhattan.huber)) {
    *error = "every huber threshold must be a positive number of sigmas";
  } else if (!is_positive(reject_chi2_1)) {
    *error = "reject_chi2_1 must be positive";
  } else if (!is_positive(line_endpoint_prior_sigma)) {
    *error = "line_endpoint_prior_sigma must be positive";
  } else if (first_iterations < 1 || second_iterations < 1) {
    *error = "first_iterations and second_iterations must be at least 1";
  } else if (!IsAvailable(solver)) {
    *error = "solver: this Ceres was built without its sparse linear algebra library";
  } else {
    return true;
  }
  return false;
}

std::vector<std::pair<std::string, const TermSummary*>> BundleAdjustmentSummary::Terms() const {
  std::vector<std::pair<std::string, const TermSummary*>> terms;
  ForEachTerm([&](const auto& term) { terms.emplace_back(term.name, &(this->*term.summary)); });
  return terms;
}

std::string BundleAdjustmentSummary::BriefReport() const {
  std::string report = FormatText(
      "local BA: %s, %d iterations, cost %.6g -> %.6g, %d behind camera",
      usable ? "solved" : "failed", num_iterations, initial_cost, final_cost, num_behind_camera);
  for (const auto& [name, term] : Terms()) {
    std::string label = name;
    std::replace(label.begin(), label.end(), '_', ' ');
    report += FormatText("\n  %-19s %6d blocks, %4d rejected, cost %.6g -> %.6g", label.c_str(),
                         term->num_residual_blocks, term->num_rejected, term->initial_cost,
                         term->final_cost);
  }
  return report + "\n  " + schur_structure + (message.empty() ? "" : ": ") + message;
}

}  // namespace msc_vo
