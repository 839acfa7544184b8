// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

#include <optional>
#include <utility>

namespace msc_vo {

namespace {

class WindowTermsBuilder {
 public:
  WindowTermsBuilder(const BundleAdjustmentOptions& options, const WindowData& data,
                     const WindowIndex& index, const WindowInlierMask& inlier_mask,
                     const WindowState& state)
      : options_(options), data_(data), index_(index), inlier_mask_(inlier_mask), state_(state) {
    terms_.keyframe_constrained.assign(data.keyframes.size(), false);
    terms_.point_constrained.assign(data.points.size(), false);
    terms_.line_constrained.assign(data.lines.size(), false);
    terms_.extra_constrained.assign(state.NumExtra(), false);
  }

  WindowTerms Build() {
    AddPoints();
    AddLines();
    AddCustomFactors();
    // The terms below depend on line_constrained.
    AddEndpointPriors();
    AddPairs(options_.parallel, data_.parallel_pairs, index_.parallel, inlier_mask_.parallel,
             &terms_.parallel);
    AddPairs(options_.perpendicular, data_.perpendicular_pairs, index_.perpendicular,
             inlier_mask_.perpendicular, &terms_.perpendicular);
    AddAlignments();
    AddPriors();
    return std::move(terms_);
  }

 private:
  void AddPoints() {
    terms_.point_reprojection.loss.threshold = options_.point_reprojection.huber;
    terms_.point_depth.loss.threshold = options_.point_depth.huber;
    terms_.point_reprojection.blocks.reserve(index_.points.size());
    terms_.point_depth.blocks.reserve(index_.points.size());
    for (size_t i = 0; i < index_.points.size(); ++i) {
      const auto& [keyframe, point] = index_.points[i];
      const WindowData::PointObservation& o = data_.point_observations[i];
      const double noise = data_.points[point].noise;
      const InlierMask used = Enabled(inlier_mask_.points[i], options_.point_reprojection.enabled,
                                      options_.point_depth.enabled);
      if (used.reprojection) {
        terms_.point_reprojection.blocks.push_back(
            {PointReprojection(data_.camera, o.pixel, noise * o.sigma), keyframe, point,
             Source(i)});
      }
      if (used.depth) {
        terms_.point_depth.blocks.push_back(
            {DepthReprojection(o.inverse_depth, noise * o.inverse_depth_sigma), keyframe, point,
             Source(i)});
      }
      if (used.reprojection || used.depth) {
        terms_.keyframe_constrained[keyframe] = terms_.point_constrained[point] = true;
      }
    }
  }

  void AddLines() {
    terms_.line_reprojection.loss.threshold = options_.line_reprojection.huber;
    terms_.line_depth.loss.threshold = options_.line_depth.huber;
    for (size_t i = 0; i < index_.lines.size(); ++i) {
      const auto& [keyframe, line] = index_.lines[i];
      const WindowData::LineObservation& o = data_.line_observations[i];
      const double noise = data_.lines[line].noise;
      const InlierMask used = Enabled(inlier_mask_.lines[i], options_.line_reprojection.enabled,
                                      options_.line_depth.enabled);
      if (!used.reprojection && !used.depth) continue;
      const LineSegment3 whole = state_.Pose(keyframe) * state_.Line(line);
      const std::optional<LinePart> part = ObservedPart(data_.camera, o.segment, whole);
      if (!part) continue;  // moved behind the camera by an earlier solve
      const LineSegment3 in_cam = part->Of(whole);
      terms_.keyframe_constrained[keyframe] = terms_.line_constrained[line] = true;
      if (used.reprojection) {
        LineReprojection factor =
            MakeLineReprojection(data_.camera, o.segment, noise * o.sigma, in_cam);
        factor.SetPart(*part);
        terms_.line_reprojection.blocks.push_back({factor, keyframe, line, Source(i)});
      }
      if (used.depth) {
        LineDepth depth = Nearer(o.depth, data_.lines[line].depth_offset);
        depth.covariance *= noise * noise;
        LineDepthReprojection factor =
            MakeLineDepthReprojection(data_.camera, o.segment, depth, in_cam);
        factor.SetPart(*part);
        terms_.line_depth.blocks.push_back({factor, keyframe, line, Source(i)});
      }
    }
  }

  void AddCustomFactors() {
    for (size_t i = 0; i < index_.custom_factors.size(); ++i) {
      terms_.custom.blocks.push_back({&data_.custom_factors[i], index_.custom_factors[i]});
      for (const StateBlock& block : index_.custom_factors[i]) {
        Constrained(block.kind)[block.position] = true;
      }
    }
  }
  std::vector<bool>& Constrained(StateBlock::Kind kind) {
    if (kind == StateBlock::Kind::kPose) return terms_.keyframe_constrained;
    if (kind == StateBlock::Kind::kPoint) return terms_.point_constrained;
    return kind == StateBlock::Kind::kLine ? terms_.line_constrained : terms_.extra_constrained;
  }

  void AddEndpointPriors() {
    if (!options_.line_endpoint_prior) return;
    for (size_t i = 0; i < data_.lines.size(); ++i) {
      if (!IsFree(Source(i))) continue;
      terms_.line_endpoint_prior.blocks.push_back(
          {LineEndpointPrior(data_.lines[i].segment, options_.line_endpoint_prior_sigma), Source(i),
           -1, Source(i)});
    }
  }

  template <typename Factor>
  void AddPairs(const TermOptions& options, const std::vector<WindowData::LinePair>& pairs,
                const std::vector<WindowIndex::Pair>& lines, const std::vector<bool>& inliers,
                WindowTerm<Factor>* term) {
    term->loss.threshold = options.huber;
    if (!options.enabled) return;
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto& [a, b] = lines[i];
      if (!inliers[i] || !terms_.line_constrained[a] || !terms_.line_constrained[b]) continue;
      if (!IsFree(a) && !IsFree(b)) continue;
      term->blocks.push_back({Factor(pairs[i].sigma), a, b, Source(i), pairs[i].count});
    }
  }

  void AddAlignments() {
    terms_.manhattan.loss.threshold = options_.manhattan.huber;
    if (!options_.manhattan.enabled) return;
    for (size_t i = 0; i < index_.alignments.size(); ++i) {
      if (!inlier_mask_.alignments[i] || !IsFree(index_.alignments[i])) continue;
      const WindowData::AxisAlignment& alignment = data_.axis_alignments[i];
      terms_.manhattan.blocks.push_back({ManhattanAxisAlignment(alignment.axis, alignment.sigma),
                                         index_.alignments[i], -1, Source(i)});
    }
  }

  // Priors have no robust loss: they contain no outliers.
  void AddPriors() {
    for (size_t i = 0; i < index_.priors.size(); ++i) {
      const int keyframe = index_.priors[i];
      if (data_.keyframes[keyframe].fixed) continue;
      const WindowData::PosePrior& prior = data_.pose_priors[i];
      terms_.keyframe_constrained[keyframe] = true;
      terms_.pose_prior.blocks.push_back(
          {PosePrior(prior.cam_from_world, prior.covariance), keyframe, -1, Source(i)});
    }
  }

  static int Source(size_t i) { return static_cast<int>(i); }
  static InlierMask Enabled(const InlierMask& inlier, bool reprojection, bool depth) {
    return {inlier.reprojection && reprojection, inlier.depth && depth};
  }
  bool IsFree(int line) const { return !data_.lines[line].fixed && terms_.line_constrained[line]; }

  const BundleAdjustmentOptions& options_;
  const WindowData& data_;
  const WindowIndex& index_;
  const WindowInlierMask& inlier_mask_;
  const WindowState& state_;
  WindowTerms terms_;
};

}  // namespace

WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state) {
  return WindowTermsBuilder(options, data, index, inlier_mask, state).Build();
}

double Cost(const WindowTerms& terms, const WindowState& state) {
  return Cost(terms.point_reprojection, state) + Cost(terms.point_depth, state) +
         Cost(terms.line_reprojection, state) + Cost(terms.line_depth, state) +
         Cost(terms.line_endpoint_prior, state) + Cost(terms.parallel, state) +
         Cost(terms.perpendicular, state) + Cost(terms.manhattan, state) +
         Cost(terms.pose_prior, state) + Cost(terms.custom, state);
}

}  // namespace msc_vo
