// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

#include <algorithm>
#include <optional>
#include <type_traits>
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
    for (const WindowData::Line& line : data.lines) terms_.line_constrained.push_back(line.fixed);
    terms_.extra_constrained.assign(state.NumExtra(), false);
  }

  WindowTerms Build() {
    ForEachTerm([this](const auto& term) { SetLoss(term); });
    AddPoints();
    AddLines();
    AddCustomFactors();
    // The terms below depend on line_constrained.
    AddEndpointPriors();
    ForEachRelation([this](const auto& term) { AddRelations(term); });
    AddPosePriors();
    return std::move(terms_);
  }

 private:
  template <typename Factor>
  void SetLoss(const Term<Factor>& term) {
    if constexpr (!std::is_same_v<Factor, CustomFactor>) {
      if (term.options == nullptr) return;
      terms_.Of<Factor>().loss.threshold = (options_.*term.options).huber;
    }
  }

  void AddPoints() {
    auto& reprojections = terms_.Of<PointReprojection>().blocks;
    auto& depths = terms_.Of<DepthReprojection>().blocks;
    reprojections.reserve(index_.points.size());
    depths.reserve(index_.points.size());
    for (size_t i = 0; i < index_.points.size(); ++i) {
      const auto& [keyframe, point] = index_.points[i];
      const WindowData::PointObservation& o = data_.point_observations[i];
      const double noise = data_.points[point].noise;
      const InlierMask used = Enabled(inlier_mask_.points[i], options_.point_reprojection.enabled,
                                      options_.point_depth.enabled);
      if (used.reprojection) {
        reprojections.push_back({PointReprojection(data_.camera, o.pixel, noise * o.sigma),
                                 {keyframe, point},
                                 Source(i)});
      }
      if (used.depth) {
        depths.push_back({DepthReprojection(o.inverse_depth, noise * o.inverse_depth_sigma),
                          {keyframe, point},
                          Source(i)});
      }
      if (used.reprojection || used.depth) {
        terms_.keyframe_constrained[keyframe] = terms_.point_constrained[point] = true;
      }
    }
  }

  void AddLines() {
    auto& reprojections = terms_.Of<LineReprojection>().blocks;
    auto& depths = terms_.Of<LineDepthReprojection>().blocks;
    reprojections.reserve(index_.lines.size());
    depths.reserve(index_.lines.size());
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
        reprojections.push_back({factor, {keyframe, line}, Source(i)});
      }
      if (used.depth) {
        LineDepth depth = Nearer(o.depth, data_.lines[line].depth_offset);
        depth.covariance *= noise * noise;
        LineDepthReprojection factor =
            MakeLineDepthReprojection(data_.camera, o.segment, depth, in_cam);
        factor.SetPart(*part);
        depths.push_back({factor, {keyframe, line}, Source(i)});
      }
    }
  }

  void AddCustomFactors() {
    for (size_t i = 0; i < index_.custom_factors.size(); ++i) {
      terms_.Of<CustomFactor>().blocks.push_back(
          {&data_.custom_factors[i], index_.custom_factors[i]});
      for (const StateBlock& block : index_.custom_factors[i]) {
        terms_.Constrained(block.kind)[block.position] = true;
      }
    }
  }

  void AddEndpointPriors() {
    if (!options_.line_endpoint_prior) return;
    for (size_t i = 0; i < data_.lines.size(); ++i) {
      if (!IsFree(Source(i))) continue;
      terms_.Of<LineEndpointPrior>().blocks.push_back(
          {LineEndpointPrior(data_.lines[i].segment, options_.line_endpoint_prior_sigma),
           {Source(i)},
           Source(i)});
    }
  }

  static ManhattanAxisAlignment Make(const Term<ManhattanAxisAlignment>&,
                                     const WindowData::AxisAlignment& alignment) {
    return {alignment.axis, alignment.sigma};
  }
  template <typename Factor>
  static Factor Make(const Term<Factor>&, const WindowData::LinePair& pair) {
    return Factor(pair.sigma);
  }
  static int Multiplicity(const WindowData::AxisAlignment&) { return 1; }
  static int Multiplicity(const WindowData::LinePair& pair) { return pair.count; }

  // Relations of observed or fixed lines, at least one of which is free.
  template <typename Factor, typename Record>
  void AddRelations(const RelationTerm<Factor, Record>& term) {
    if (!(options_.*term.options).enabled) return;
    const std::vector<Record>& records = data_.*term.records;
    terms_.Of<Factor>().blocks.reserve(records.size());
    for (size_t i = 0; i < records.size(); ++i) {
      const auto& lines = (index_.*term.lines)[i];
      const auto is_constrained = [this](int line) { return terms_.line_constrained[line]; };
      const auto is_free = [this](int line) { return IsFree(line); };
      if (!(inlier_mask_.*term.inliers)[i] ||
          !std::all_of(lines.begin(), lines.end(), is_constrained) ||
          !std::any_of(lines.begin(), lines.end(), is_free)) {
        continue;
      }
      terms_.Of<Factor>().blocks.push_back(
          {Make(term, records[i]), lines, Source(i), Multiplicity(records[i])});
    }
  }

  // Priors have no robust loss: they contain no outliers.
  void AddPosePriors() {
    for (size_t i = 0; i < index_.priors.size(); ++i) {
      const int keyframe = index_.priors[i];
      if (data_.keyframes[keyframe].fixed) continue;
      const WindowData::PosePrior& prior = data_.pose_priors[i];
      terms_.keyframe_constrained[keyframe] = true;
      terms_.Of<PosePrior>().blocks.push_back(
          {PosePrior(prior.cam_from_world, prior.covariance), {keyframe}, Source(i)});
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

std::vector<bool>& WindowTerms::Constrained(BlockKind kind) {
  if (kind == BlockKind::kPose) return keyframe_constrained;
  if (kind == BlockKind::kPoint) return point_constrained;
  return kind == BlockKind::kLine ? line_constrained : extra_constrained;
}

WindowTerms MakeWindowTerms(const BundleAdjustmentOptions& options, const WindowData& data,
                            const WindowIndex& index, const WindowInlierMask& inlier_mask,
                            const WindowState& state) {
  return WindowTermsBuilder(options, data, index, inlier_mask, state).Build();
}

double Cost(const WindowTerms& terms, const WindowState& state) {
  double sum = 0.0;
  ForEachTerm(terms, [&](const auto&, const auto& blocks) { sum += Cost(blocks, state); });
  return sum;
}

std::vector<CustomParameter> ParametersOf(const WindowTerm<CustomFactor>::Block& block,
                                          const WindowState& state) {
  std::vector<CustomParameter> parameters;
  parameters.reserve(block.parameters.size());
  for (const StateBlock& b : block.parameters) {
    parameters.push_back({state.Block(b), state.Size(b), state.ManifoldOf(b), true});
  }
  return parameters;
}

double Cost(const WindowTerm<CustomFactor>& term, const WindowState& state) {
  double sum = 0.0;
  for (const WindowTerm<CustomFactor>::Block& block : term.blocks) {
    const CustomFactor& factor = *block.factor;
    sum += CustomFactorCost(*factor.cost, factor.loss.get(), ParametersOf(block, state));
  }
  return sum;
}

}  // namespace msc_vo
