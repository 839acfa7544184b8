// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/problems/window_problem.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include <ceres/solver.h>

#include "msc_vo/problems/validation.h"
#include "msc_vo/problems/window_builder.h"
#include "msc_vo/problems/window_validation.h"

namespace msc_vo {

namespace {

// Every observation in front of its camera takes part at first; the others are counted.
WindowActivity AllInFront(const WindowOptions& options, const WindowIndex& index,
                          const WindowData& data, int* num_behind) {
  WindowActivity activity;
  activity.points.resize(index.points.size());
  activity.lines.resize(index.lines.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    const WindowIndex::Link& link = index.points[i];
    const bool in_front = IsInFront(data.keyframes[link.keyframe].cam_from_world *
                                    data.points[link.landmark].position);
    const bool has_depth =
        options.point_depth.enabled && data.point_observations[i].inverse_depth > 0.0;
    activity.points[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  for (size_t i = 0; i < index.lines.size(); ++i) {
    const WindowIndex::Link& link = index.lines[i];
    const bool in_front =
        IsInFront(data.keyframes[link.keyframe].cam_from_world * data.lines[link.landmark].segment);
    const bool has_depth = options.line_depth.enabled && data.line_observations[i].has_depth;
    activity.lines[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  activity.parallel.assign(index.parallel.size(), true);
  activity.perpendicular.assign(index.perpendicular.size(), true);
  activity.alignments.assign(index.alignments.size(), true);
  return activity;
}

// Chi-square test of the observations of one kind at the present solution.
void Classify(const WindowTerm& reprojection, const WindowTerm& depth, double limit,
              double limit_with_depth, std::vector<Activity>* activity, int* num_rejected,
              int* num_depths_rejected) {
  std::vector<double> pixels(activity->size(), 0.0);
  std::vector<double> depths(activity->size(), 0.0);
  const auto scatter = [](const WindowTerm& term, std::vector<double>* by_observation) {
    const std::vector<double> chi_squares = term.ChiSquares();
    for (size_t i = 0; i < chi_squares.size(); ++i) {
      (*by_observation)[term.blocks[i].source] = chi_squares[i];
    }
  };
  scatter(reprojection, &pixels);
  scatter(depth, &depths);
  for (size_t i = 0; i < activity->size(); ++i) {
    Activity& now = (*activity)[i];
    if (!now.reprojection) continue;  // behind its camera
    const Activity test = TestChiSquare(pixels[i], depths[i], limit, limit_with_depth);
    *num_rejected += !test.reprojection;
    *num_depths_rejected += now.depth && test.reprojection && !test.depth;
    now = {test.reprojection, now.depth && test.depth};
  }
}

// The same of pairs or alignments.
void Classify(const WindowTerm& term, double limit, std::vector<bool>* active, int* num_rejected) {
  const std::vector<double> chi_squares = term.ChiSquares();
  for (size_t i = 0; i < chi_squares.size(); ++i) {
    const bool passes = chi_squares[i] <= limit;
    (*active)[term.blocks[i].source] = passes;
    *num_rejected += !passes;
  }
}

void ClassifyAll(const WindowOptions& options, const WindowBuilder& builder,
                 WindowActivity* activity, WindowSummary* summary) {
  Classify(builder.point_reprojection, builder.point_depth, options.reject_chi2_2,
           options.reject_chi2_3, &activity->points, &summary->point_reprojection.num_rejected,
           &summary->point_depth.num_rejected);
  Classify(builder.line_reprojection, builder.line_depth, options.reject_chi2_2,
           options.reject_chi2_4, &activity->lines, &summary->line_reprojection.num_rejected,
           &summary->line_depth.num_rejected);
  Classify(builder.parallel, options.reject_chi2_2, &activity->parallel,
           &summary->parallel.num_rejected);
  Classify(builder.perpendicular, options.reject_chi2_1, &activity->perpendicular,
           &summary->perpendicular.num_rejected);
  Classify(builder.manhattan, options.reject_chi2_2, &activity->alignments,
           &summary->manhattan.num_rejected);
}

ceres::Solver::Summary Solve(int max_iterations, WindowBuilder* builder) {
  ceres::Solver::Options options;
  options.max_num_iterations = max_iterations;
  // The reduced system is small (6 per free keyframe) and mostly full in a window of covisible
  // keyframes.
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering = builder->EliminationOrdering();
  // One thread: more would add up in another order, and gain nothing at this size.
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, builder->problem(), &summary);
  return summary;
}

// Every term of the builder with its summary.
using TermPair = std::pair<const WindowTerm*, TermSummary*>;
std::array<TermPair, 8> Terms(const WindowBuilder& builder, WindowSummary* summary) {
  return {{{&builder.point_reprojection, &summary->point_reprojection},
           {&builder.point_depth, &summary->point_depth},
           {&builder.line_reprojection, &summary->line_reprojection},
           {&builder.line_depth, &summary->line_depth},
           {&builder.line_anchor, &summary->line_anchor},
           {&builder.parallel, &summary->parallel},
           {&builder.perpendicular, &summary->perpendicular},
           {&builder.manhattan, &summary->manhattan}}};
}

// Writes the costs of all terms into one member of their summaries; returns their sum.
double WriteCosts(const WindowBuilder& builder, double TermSummary::*member,
                  WindowSummary* summary) {
  double sum = 0.0;
  for (const auto& [term, its_summary] : Terms(builder, summary)) {
    its_summary->*member = term->Cost();
    sum += its_summary->*member;
  }
  return sum;
}

void WriteCounts(const WindowBuilder& builder, WindowSummary* summary) {
  for (const auto& [term, its_summary] : Terms(builder, summary)) {
    its_summary->num_residual_blocks = static_cast<int>(term->blocks.size());
  }
}

// Only what took part in the last solve: a landmark or keyframe that lost its last observation
// keeps the values it came with.
void WriteBack(const ceres::Problem& problem, const WindowActivity& activity, WindowState* state,
               WindowData* data) {
  for (size_t i = 0; i < data->keyframes.size(); ++i) {
    if (!problem.HasParameterBlock(state->PoseBlock(i))) continue;
    data->keyframes[i].cam_from_world = state->Pose(i);
  }
  for (size_t i = 0; i < data->points.size(); ++i) {
    if (!problem.HasParameterBlock(state->PointBlock(i))) continue;
    data->points[i].position = state->Point(i);
  }
  for (size_t i = 0; i < data->lines.size(); ++i) {
    if (!problem.HasParameterBlock(state->LineBlock(i))) continue;
    data->lines[i].segment = state->Line(i);
  }
  for (size_t i = 0; i < activity.points.size(); ++i) {
    data->point_observations[i].rejected = !activity.points[i].reprojection;
  }
  for (size_t i = 0; i < activity.lines.size(); ++i) {
    data->line_observations[i].rejected = !activity.lines[i].reprojection;
  }
  for (size_t i = 0; i < activity.parallel.size(); ++i) {
    data->parallel_pairs[i].rejected = !activity.parallel[i];
  }
  for (size_t i = 0; i < activity.perpendicular.size(); ++i) {
    data->perpendicular_pairs[i].rejected = !activity.perpendicular[i];
  }
  for (size_t i = 0; i < activity.alignments.size(); ++i) {
    data->axis_alignments[i].rejected = !activity.alignments[i];
  }
}

}  // namespace

WindowSummary SolveWindow(const WindowOptions& options, WindowData* data) {
  const WindowIndex index = ValidateWindow(options, *data);
  WindowSummary summary;
  WindowActivity activity = AllInFront(options, index, *data, &summary.num_behind_camera);
  WindowState state(*data);

  const auto solve = [&](int iterations, WindowBuilder* builder) {
    const ceres::Solver::Summary result = Solve(iterations, builder);
    summary.num_iterations += static_cast<int>(result.iterations.size());
    summary.schur_structure = result.schur_structure_used;
    summary.message = result.message;
    return result.IsSolutionUsable() && state.AllFinite();
  };

  WindowBuilder first(options, *data, index, activity, &state);
  summary.initial_cost = WriteCosts(first, &TermSummary::initial_cost, &summary);
  if (!solve(options.first_iterations, &first)) return summary;
  ClassifyAll(options, first, &activity, &summary);

  WindowBuilder second(options, *data, index, activity, &state);
  if (!solve(options.second_iterations, &second)) return summary;
  WriteCounts(second, &summary);
  summary.final_cost = WriteCosts(second, &TermSummary::final_cost, &summary);
  summary.usable = true;
  WriteBack(*second.problem(), activity, &state, data);
  return summary;
}

bool WindowOptions::IsValid(std::string* error) const {
  if (!CommonOptionsAreValid(*this, error)) return false;
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(parallel.huber) || !is_positive(perpendicular.huber) ||
      !is_positive(manhattan.huber)) {
    *error = "every huber threshold must be a positive number of sigmas";
  } else if (!is_positive(reject_chi2_1)) {
    *error = "reject_chi2_1 must be positive";
  } else if (!is_positive(line_anchor_sigma)) {
    *error = "line_anchor_sigma must be positive";
  } else if (first_iterations < 1 || second_iterations < 1) {
    *error = "first_iterations and second_iterations must be at least 1";
  } else {
    return true;
  }
  return false;
}

std::string WindowSummary::BriefReport() const {
  char text[160];
  std::snprintf(
      text, sizeof(text), "window: %s, %d iterations, cost %.6g -> %.6g, %d behind camera",
      usable ? "solved" : "failed", num_iterations, initial_cost, final_cost, num_behind_camera);
  std::string report = text;
  const auto add = [&](const char* name, const TermSummary& term) {
    std::snprintf(text, sizeof(text), "\n  %-18s %6d blocks, %4d rejected, cost %.6g -> %.6g", name,
                  term.num_residual_blocks, term.num_rejected, term.initial_cost, term.final_cost);
    report += text;
  };
  add("point reprojection", point_reprojection);
  add("point depth", point_depth);
  add("line reprojection", line_reprojection);
  add("line depth", line_depth);
  add("line anchor", line_anchor);
  add("parallel", parallel);
  add("perpendicular", perpendicular);
  add("manhattan", manhattan);
  return report + "\n  " + schur_structure + (message.empty() ? "" : ": ") + message;
}

}  // namespace msc_vo
