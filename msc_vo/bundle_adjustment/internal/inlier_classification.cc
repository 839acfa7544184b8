// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"

namespace msc_vo {

WindowInlierMask InitialInlierMask(const BundleAdjustmentOptions& options, const WindowIndex& index,
                                   const WindowData& data, int* num_behind) {
  WindowInlierMask inlier_mask;
  inlier_mask.points.resize(index.points.size());
  inlier_mask.lines.resize(index.lines.size());
  for (size_t i = 0; i < index.points.size(); ++i) {
    const WindowIndex::Observation& observation = index.points[i];
    const bool in_front = IsInFront(data.keyframes[observation.keyframe].cam_from_world *
                                    data.points[observation.landmark].position);
    const bool has_depth =
        options.point_depth.enabled && data.point_observations[i].inverse_depth > 0.0;
    inlier_mask.points[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  for (size_t i = 0; i < index.lines.size(); ++i) {
    const WindowIndex::Observation& observation = index.lines[i];
    const bool in_front = ObservedPart(data.camera, data.line_observations[i].segment,
                                       data.keyframes[observation.keyframe].cam_from_world *
                                           data.lines[observation.landmark].segment)
                              .has_value();
    const bool has_depth = options.line_depth.enabled && data.line_observations[i].has_depth;
    inlier_mask.lines[i] = {in_front, in_front && has_depth};
    *num_behind += !in_front;
  }
  ForEachRelation([&](const auto& term) {
    (inlier_mask.*term.inliers).assign((data.*term.records).size(), true);
  });
  return inlier_mask;
}

WindowInlierMask UnrejectedInlierMask(const BundleAdjustmentOptions& options,
                                      const WindowIndex& index, const WindowData& data) {
  int num_behind = 0;
  WindowInlierMask inlier_mask = InitialInlierMask(options, index, data, &num_behind);
  const auto drop_rejected = [](const auto& records, auto* inliers) {
    for (size_t i = 0; i < records.size(); ++i) {
      if (records[i].rejected) (*inliers)[i] = {};
    }
  };
  const auto drop_depths = [](const auto& observations, std::vector<InlierMask>* inliers) {
    for (size_t i = 0; i < observations.size(); ++i) {
      if (observations[i].depth_rejected) (*inliers)[i].depth = false;
    }
  };
  drop_rejected(data.point_observations, &inlier_mask.points);
  drop_rejected(data.line_observations, &inlier_mask.lines);
  drop_depths(data.point_observations, &inlier_mask.points);
  drop_depths(data.line_observations, &inlier_mask.lines);
  ForEachRelation(
      [&](const auto& term) { drop_rejected(data.*term.records, &(inlier_mask.*term.inliers)); });
  return inlier_mask;
}

namespace {

// Tests the observations of points or of lines.
template <typename Reprojection, typename Depth>
void Reject(const WindowTerm<Reprojection>& reprojection, const WindowTerm<Depth>& depth,
            const WindowState& state, double limit, double limit_with_depth,
            std::vector<InlierMask>* inlier_mask, int* num_rejected, int* num_depths_rejected) {
  std::vector<double> pixels(inlier_mask->size(), 0.0);
  std::vector<double> depths(inlier_mask->size(), 0.0);
  for (const auto& block : reprojection.blocks) {
    pixels[block.source] = ChiSquare<Reprojection>(block, state);
  }
  for (const auto& block : depth.blocks) depths[block.source] = ChiSquare<Depth>(block, state);
  for (size_t i = 0; i < inlier_mask->size(); ++i) {
    InlierMask& inlier = (*inlier_mask)[i];
    if (!inlier.reprojection) continue;  // behind its camera
    const InlierMask test = TestChiSquare(pixels[i], depths[i], limit, limit_with_depth);
    *num_rejected += !test.reprojection;
    *num_depths_rejected += inlier.depth && test.reprojection && !test.depth;
    inlier = {test.reprojection, inlier.depth && test.depth};
  }
}

// Tests relations.
template <typename Factor>
void Reject(const WindowTerm<Factor>& term, const WindowState& state, double limit,
            std::vector<bool>* inliers, int* num_rejected) {
  for (const auto& block : term.blocks) {
    const bool passes = ChiSquare<Factor>(block, state) <= limit;
    (*inliers)[block.source] = passes;
    *num_rejected += !passes;
  }
}

}  // namespace

void RejectOutliers(const BundleAdjustmentOptions& options, const WindowTerms& terms,
                    const WindowState& state, WindowInlierMask* inlier_mask,
                    BundleAdjustmentSummary* summary) {
  Reject(terms.Of<PointReprojection>(), terms.Of<DepthReprojection>(), state, options.reject_chi2_2,
         options.reject_chi2_3, &inlier_mask->points, &summary->point_reprojection.num_rejected,
         &summary->point_depth.num_rejected);
  Reject(terms.Of<LineReprojection>(), terms.Of<LineDepthReprojection>(), state,
         options.reject_chi2_2, options.reject_chi2_4, &inlier_mask->lines,
         &summary->line_reprojection.num_rejected, &summary->line_depth.num_rejected);
  ForEachRelation([&](const auto& term) {
    Reject(terms.Of<typename std::decay_t<decltype(term)>::Factor>(), state, options.*term.limit,
           &(inlier_mask->*term.inliers), &(summary->*term.summary).num_rejected);
  });
}

}  // namespace msc_vo
