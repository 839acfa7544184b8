// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

namespace {

class TermMaker {
 public:
  TermMaker(const BundleAdjustmentOptions& options, const WindowData& data,
            const WindowIndex& index, const WindowInlierMask& inlier_mask, const WindowState& state)
      : options_(options), data_(data), index_(index), activity_(inlier_mask), state_(state) {
    terms_.keyframe_takes_part.assign(data.keyframes.size(), false);
    terms_.point_observed.assign(data.points.size(), false);
    terms_.line_observed.assign(data.lines.size(), false);
  }

  WindowTerms Make() {
    AddPoints();
    AddLines();
    // After the observations: they say which lines are there to be bound.
    AddEndpointPriors();
    AddPairs(options_.parallel, data_.parallel_pairs, index_.parallel, activity_.parallel,
             &terms_.parallel);
    AddPairs(options_.perpendicular, data_.perpendicular_pairs, index_.perpendicular,
             activity_.perpendicular, &terms_.perpendicular);
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
      const InlierMask active = Enabled(activity_.points[i], options_.point_reprojection.enabled,
                                        options_.point_depth.enabled);
      if (active.reprojection) {
        terms_.point_reprojection.blocks.push_back(
            {PointReprojection(data_.camera, o.pixel, noise * o.sigma), keyframe, point,
             Source(i)});
      }
      if (active.depth) {
        terms_.point_depth.blocks.push_back(
            {DepthReprojection(o.inverse_depth, noise * o.inverse_depth_sigma), keyframe, point,
             Source(i)});
      }
      if (active.reprojection || active.depth) {
        terms_.keyframe_takes_part[keyframe] = terms_.point_observed[point] = true;
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
      const InlierMask active = Enabled(activity_.lines[i], options_.line_reprojection.enabled,
                                        options_.line_depth.enabled);
      if (!active.reprojection && !active.depth) continue;
      terms_.keyframe_takes_part[keyframe] = terms_.line_observed[line] = true;
      const LineSegment3 in_cam = state_.Pose(keyframe) * state_.Line(line);
      if (active.reprojection) {
        terms_.line_reprojection.blocks.push_back(
            {MakeLineReprojection(data_.camera, o.segment, noise * o.sigma, in_cam), keyframe, line,
             Source(i)});
      }
      if (active.depth) {
        LineDepth depth = Nearer(o.depth, data_.lines[line].depth_offset);
        depth.covariance *= noise * noise;
        terms_.line_depth.blocks.push_back(
            {MakeLineDepthReprojection(data_.camera, o.segment, depth, in_cam), keyframe, line,
             Source(i)});
      }
    }
  }

  // For every line that an observation could move.
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
                const std::vector<WindowIndex::Pair>& lines, const std::vector<bool>& active,
                WindowTerm<Factor>* term) {
    term->loss.threshold = options.huber;
    if (!options.enabled) return;
    for (size_t i = 0; i < pairs.size(); ++i) {
      const auto& [a, b] = lines[i];
      if (!active[i] || !terms_.line_observed[a] || !terms_.line_observed[b]) continue;
      if (!IsFree(a) && !IsFree(b)) continue;
      term->blocks.push_back({Factor(pairs[i].sigma), a, b, Source(i), pairs[i].count});
    }
  }

  void AddAlignments() {
    terms_.manhattan.loss.threshold = options_.manhattan.huber;
    if (!options_.manhattan.enabled) return;
    for (size_t i = 0; i < index_.alignments.size(); ++i) {
      if (!activity_.alignments[i] || !IsFree(index_.alignments[i])) continue;
      const WindowData::AxisAlignment& alignment = data_.axis_alignments[i];
      terms_.manhattan.blocks.push_back({ManhattanAxisAlignment(alignment.axis, alignment.sigma),
                                         index_.alignments[i], -1, Source(i)});
    }
  }

  // No loss: a prior is not one of many measurements, some of which are wrong.
  void AddPriors() {
    for (size_t i = 0; i < index_.priors.size(); ++i) {
      const int keyframe = index_.priors[i];
      if (data_.keyframes[keyframe].fixed) continue;
      const WindowData::PosePrior& prior = data_.pose_priors[i];
      terms_.keyframe_takes_part[keyframe] = true;
      terms_.pose_prior.blocks.push_back(
          {PosePrior(prior.cam_from_world, prior.covariance), keyframe, -1, Source(i)});
    }
  }

  static int Source(size_t i) { return static_cast<int>(i); }
  static InlierMask Enabled(const InlierMask& active, bool reprojection, bool depth) {
    return {active.reprojection && reprojection, active.depth && depth};
  }
  // An observation could move it.
  bool IsFree(int line) const { return !data_.lines[line].fixed && terms_.line_observed[line]; }

  const BundleAdjustmentOptions& options_;
  const WindowData& data_;
  const WindowIndex& index_;
  const WindowInlierMask& activity_;
  const WindowState& state_;
  WindowTerms terms_;
};

}  // namespace

WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state) {
  return TermMaker(options, data, index, inlier_mask, state).Make();
}

double Cost(const WindowTerms& terms, const WindowState& state) {
  return Cost(terms.point_reprojection, state) + Cost(terms.point_depth, state) +
         Cost(terms.line_reprojection, state) + Cost(terms.line_depth, state) +
         Cost(terms.line_endpoint_prior, state) + Cost(terms.parallel, state) +
         Cost(terms.perpendicular, state) + Cost(terms.manhattan, state) +
         Cost(terms.pose_prior, state);
}

}  // namespace msc_vo
