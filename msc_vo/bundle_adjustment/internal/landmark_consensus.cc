// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_consensus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "msc_vo/bundle_adjustment/internal/inlier_classification.h"
#include "msc_vo/bundle_adjustment/internal/landmark_fit.h"

namespace msc_vo {

namespace {

template <int Points>
using Views = std::vector<LandmarkView<Points>>;

// Separates the outliers of single landmarks from their inliers.
template <int Points>
class ConsensusFinder {
 public:
  using Vector = Eigen::Matrix<double, 3 * Points, 1>;
  using Fit = LandmarkFit<Points>;

  // The limits are those of the chi-square test of an observation without and with depth.
  ConsensusFinder(const PinholeCamera& camera, double limit, double limit_with_depth)
      : camera_(camera), limit_(limit), limit_with_depth_(limit_with_depth) {}

  // Removes the outliers from *views. Returns the fit to the rest.
  Fit RemoveOutliers(const Vector& start, bool fixed, Views<Points>* views) const {
    const size_t count = views->size();
    Fit fit = FitLandmark<Points>(camera_, *views, start, fixed);
    // T_i <= c: most landmarks are fitted once.
    while (std::isfinite(fit.cost) && fit.cost > limit_) {
      Rejection worst = FindWorst(start, fixed, fit, *views);
      if (worst.excess <= 0.0) break;
      *views = std::move(worst.rest);
      fit = worst.fit;
    }
    const bool is_consensus =
        views->size() == count || fixed || (2 * views->size() > count && IsTested(*views));
    if (!is_consensus) {
      views->clear();
      fit.x = start;
    }
    return fit;
  }

  bool IsDetermined(const Views<Points>& views, const Vector& landmark) const {
    return RelativeSigma<Points>(camera_, views, landmark) <= kMaxRelativeSigma;
  }

 private:
  struct Rejection {
    double excess = 0.0;  // of T_i over its limit
    Views<Points> rest;
    Fit fit;
  };

  Rejection FindWorst(const Vector& start, bool fixed, const Fit& all,
                      const Views<Points>& views) const {
    Rejection worst;
    const auto test = [&](Views<Points> rest, double limit) {
      const Fit fit = FitLandmark<Points>(camera_, rest, start, fixed);
      const double excess = all.cost - fit.cost - limit;
      if (excess > worst.excess) worst = {excess, std::move(rest), fit};
    };
    for (size_t i = 0; i < views.size(); ++i) {
      const bool has_depth = views[i].depth != nullptr;
      if (has_depth) {
        Views<Points> without_depth = views;
        without_depth[i].depth = nullptr;
        // The excess of the whole observation is smaller, unless the image is an outlier as well.
        test(std::move(without_depth), limit_);
      }
      Views<Points> rest = views;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      test(std::move(rest), has_depth ? limit_with_depth_ : limit_);
    }
    return worst;
  }

  // Whether the views have more rows than the landmark has degrees of freedom.
  static bool IsTested(const Views<Points>& views) {
    constexpr int kFreedom = Points == 1 ? 3 : 4;
    size_t rows = 2 * views.size();
    for (const LandmarkView<Points>& view : views) rows += view.depth != nullptr ? Points : 0;
    return rows > kFreedom;
  }

  const PinholeCamera& camera_;
  const double limit_, limit_with_depth_;
};

// Views of each landmark, in the order of the data.
template <int Points>
std::vector<Views<Points>> ViewsOf(const WindowTerms& terms, const WindowState& state,
                                   size_t num_landmarks) {
  using View = LandmarkView<Points>;
  std::vector<Views<Points>> views(num_landmarks);
  const auto& depths = terms.Of<typename View::Depth>().blocks;
  auto depth = depths.begin();
  for (const auto& block : terms.Of<typename View::Reprojection>().blocks) {
    const auto [keyframe, landmark] = block.parameters;
    const Rigid3 cam_from_world = state.Pose(keyframe);
    while (depth != depths.end() && depth->source < block.source) ++depth;
    const bool has_depth = depth != depths.end() && depth->source == block.source;
    views[landmark].push_back({cam_from_world.rotation().toRotationMatrix(),
                               cam_from_world.translation(), &block.factor,
                               has_depth ? &depth->factor : nullptr, block.source});
  }
  return views;
}

template <int Points>
double* BlockOfLandmark(size_t i, WindowState* state) {
  return Points == 1 ? state->PointBlock(i) : state->LineBlock(i);
}
template <int Points>
Eigen::Matrix<double, 3 * Points, 1> ValueOf(size_t i, const WindowState& state) {
  return Eigen::Matrix<double, 3 * Points, 1>(Points == 1 ? state.PointBlock(i)
                                                          : state.LineBlock(i));
}

// Landmarks of the relations among the terms, or of custom factors, which may determine them.
struct CoupledLandmarks {
  CoupledLandmarks(const WindowIndex& index, const WindowData& data, const WindowTerms& terms)
      : points(data.points.size(), false), lines(data.lines.size(), false) {
    ForEachRelation([&](const auto& term) {
      for (const auto& block : terms.Of<typename std::decay_t<decltype(term)>::Factor>().blocks) {
        for (const int line : (index.*term.lines)[block.source]) lines[line] = true;
      }
    });
    for (const std::vector<StateBlock>& blocks : index.custom_factors) {
      for (const StateBlock& block : blocks) {
        if (block.kind == BlockKind::kPoint) points[block.position] = true;
        if (block.kind == BlockKind::kLine) lines[block.position] = true;
      }
    }
  }
  std::vector<bool> points, lines;
};

// `terms`: of all observations to classify, at `start`.
template <int Points, typename Landmark>
void FindConsensusOf(const ConsensusFinder<Points>& finder, const WindowTerms& terms,
                     const WindowState& start, const std::vector<Landmark>& landmarks,
                     const std::vector<bool>& coupled, WindowState* state,
                     std::vector<InlierMask>* inliers) {
  auto views = ViewsOf<Points>(terms, start, landmarks.size());
  for (size_t i = 0; i < landmarks.size(); ++i) {
    for (const LandmarkView<Points>& view : views[i]) (*inliers)[view.source] = {};
    const size_t count = views[i].size();
    const LandmarkFit<Points> fit =
        finder.RemoveOutliers(ValueOf<Points>(i, start), landmarks[i].fixed, &views[i]);
    for (const LandmarkView<Points>& view : views[i]) {
      (*inliers)[view.source] = {true, view.depth != nullptr};
    }
    if (landmarks[i].fixed || coupled[i] || !std::isfinite(fit.cost)) continue;
    if (views[i].size() < count || !finder.IsDetermined(views[i], fit.x)) {
      std::copy(fit.x.data(), fit.x.data() + fit.x.size(), BlockOfLandmark<Points>(i, state));
    }
  }
}

template <int Points, typename Landmark>
std::vector<bool> FindDeterminedOf(const PinholeCamera& camera, const WindowTerms& terms,
                                   const WindowState& state, const std::vector<Landmark>& landmarks,
                                   std::vector<bool> determined) {
  const auto views = ViewsOf<Points>(terms, state, landmarks.size());
  for (size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].fixed) determined[i] = true;
    if (determined[i]) continue;
    determined[i] =
        RelativeSigma<Points>(camera, views[i], ValueOf<Points>(i, state)) <= kMaxRelativeSigma;
  }
  return determined;
}

}  // namespace

void FindConsensus(const BundleAdjustmentOptions& options, const WindowIndex& index,
                   const WindowData& data, WindowState* state, WindowInlierMask* inlier_mask) {
  WindowData at = data;
  for (size_t i = 0; i < at.keyframes.size(); ++i) at.keyframes[i].cam_from_world = state->Pose(i);
  const WindowState start(at);
  int num_behind = 0;
  WindowInlierMask in_front = InitialInlierMask(options, index, at, &num_behind);
  inlier_mask->points = std::move(in_front.points);
  inlier_mask->lines = std::move(in_front.lines);
  const WindowTerms terms = MakeWindowTerms(options, at, index, *inlier_mask, start);
  const CoupledLandmarks coupled(index, data, terms);
  FindConsensusOf<1>({data.camera, options.reject_chi2_2, options.reject_chi2_3}, terms, start,
                     data.points, coupled.points, state, &inlier_mask->points);
  FindConsensusOf<2>({data.camera, options.reject_chi2_2, options.reject_chi2_4}, terms, start,
                     data.lines, coupled.lines, state, &inlier_mask->lines);
}

DeterminedLandmarks FindDetermined(const BundleAdjustmentOptions& options, const WindowIndex& index,
                                   const WindowData& data, const WindowInlierMask& inlier_mask,
                                   const WindowState& state) {
  const WindowTerms terms = MakeWindowTerms(options, data, index, inlier_mask, state);
  const CoupledLandmarks coupled(index, data, terms);
  return {FindDeterminedOf<1>(data.camera, terms, state, data.points, coupled.points),
          FindDeterminedOf<2>(data.camera, terms, state, data.lines, coupled.lines)};
}

}  // namespace msc_vo
