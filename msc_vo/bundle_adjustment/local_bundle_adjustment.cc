// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/bundle_adjustment/internal/ceres_backend.h"
#include "msc_vo/bundle_adjustment/internal/term_list.h"
#include "msc_vo/bundle_adjustment/stepwise_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

BundleAdjustmentSummary LocalBundleAdjustment(const BundleAdjustmentOptions& options,
                                              WindowData* data,
                                              const WindowStageObserver& enter_stage) {
  StepwiseBundleAdjustment solve(options, data, enter_stage);
  while (solve.Advance()) continue;
  return solve.summary();
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
  if (!undetermined_keyframes.empty() || !undetermined_points.empty() ||
      !undetermined_lines.empty()) {
    report += FormatText("\n  not determined: %zu keyframes, %zu points, %zu lines",
                         undetermined_keyframes.size(), undetermined_points.size(),
                         undetermined_lines.size());
  }
  return report + "\n  " + schur_structure + (message.empty() ? "" : ": ") + message;
}

}  // namespace msc_vo
