// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {

WindowInlierMask AllInFront(const BundleAdjustmentOptions& options, const WindowIndex& index,
                            const WindowData& data, int* num_behind) {
  WindowInlierMask inlier_mask;
  inlier_mask.points.resize(index.points.size());
  inlier_mask.lines.resize(index.lines.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    const WindowIndex::Link& link = index.points[i];
    const bool in_front = IsInFront(data.keyframes[link.keyframe].cam_from_world *
                                    data.points[link.landmark].position);
    const bool has_depth =
        options.point_depth.enabled && data.point_observations[i].inverse_depth > 0.0;
    inlier_mask.points[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  for (size_t i = 0; i < index.lines.size(); ++i) {
    const WindowIndex::Link& link = index.lines[i];
    const bool in_front =
        IsInFront(data.keyframes[link.keyframe].cam_from_world * data.lines[link.landmark].segment);
    const bool has_depth = options.line_depth.enabled && data.line_observations[i].has_depth;
    inlier_mask.lines[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  inlier_mask.parallel.assign(index.parallel.size(), true);
  inlier_mask.perpendicular.assign(index.perpendicular.size(), true);
  inlier_mask.alignments.assign(index.alignments.size(), true);
  return inlier_mask;
}

namespace {

// Chi-square test of the observations of one kind at the present solution.
template <typename Reprojection, typename Depth>
void Classify(const WindowTerm<Reprojection>& reprojection, const WindowTerm<Depth>& depth,
              const WindowState& state, double limit, double limit_with_depth,
              std::vector<InlierMask>* inlier_mask, int* num_rejected, int* num_depths_rejected) {
  std::vector<double> pixels(inlier_mask->size(), 0.0);
  std::vector<double> depths(inlier_mask->size(), 0.0);
  for (const auto& block : reprojection.blocks) {
    pixels[block.source] = ChiSquare<Reprojection>(block, state);
  }
  for (const auto& block : depth.blocks) depths[block.source] = ChiSquare<Depth>(block, state);
  for (size_t i = 0; i < inlier_mask->size(); ++i) {
    InlierMask& now = (*inlier_mask)[i];
    if (!now.reprojection) continue;  // behind its camera
    const InlierMask test = TestChiSquare(pixels[i], depths[i], limit, limit_with_depth);
    *num_rejected += !test.reprojection;
    *num_depths_rejected += now.depth && test.reprojection && !test.depth;
    now = {test.reprojection, now.depth && test.depth};
  }
}

// The same of pairs or alignments.
template <typename Factor>
void Classify(const WindowTerm<Factor>& term, const WindowState& state, double limit,
              std::vector<bool>* active, int* num_rejected) {
  for (const auto& block : term.blocks) {
    const bool passes = ChiSquare<Factor>(block, state) <= limit;
    (*active)[block.source] = passes;
    *num_rejected += !passes;
  }
}

}  // namespace

void ClassifyAll(const BundleAdjustmentOptions& options, const WindowTerms& terms,
                 const WindowState& state, WindowInlierMask* inlier_mask,
                 BundleAdjustmentSummary* summary) {
  Classify(terms.point_reprojection, terms.point_depth, state, options.reject_chi2_2,
           options.reject_chi2_3, &inlier_mask->points, &summary->point_reprojection.num_rejected,
           &summary->point_depth.num_rejected);
  Classify(terms.line_reprojection, terms.line_depth, state, options.reject_chi2_2,
           options.reject_chi2_4, &inlier_mask->lines, &summary->line_reprojection.num_rejected,
           &summary->line_depth.num_rejected);
  Classify(terms.parallel, state, options.reject_chi2_2, &inlier_mask->parallel,
           &summary->parallel.num_rejected);
  Classify(terms.perpendicular, state, options.reject_chi2_1, &inlier_mask->perpendicular,
           &summary->perpendicular.num_rejected);
  Classify(terms.manhattan, state, options.reject_chi2_2, &inlier_mask->alignments,
           &summary->manhattan.num_rejected);
}

}  // namespace msc_vo
