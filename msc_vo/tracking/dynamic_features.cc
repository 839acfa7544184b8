// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "msc_vo/frame/depth_surfaces.h"
#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/map/free_space.h"
#include "msc_vo/pose_estimation/cell_consensus.h"

namespace msc_vo {

namespace {

// Keyframes whose depth images are consulted, apart from the reference keyframe.
constexpr size_t kMaxKeyframes = 20;
// Features that a surface needs to be dynamic: as many as determine a plane.
constexpr int kMinDynamic = 3;

// Classification of a feature's surface.
enum class Evidence { kNone, kStatic, kDynamic };

// A keyframe that may have observed the same space.
struct KeyframeView {
  const Frame* frame = nullptr;
  Rigid3 view_from_cam;
};

// The reference keyframe, its covisible ones, and the newest ones: a reference keyframe of a frame
// that shows little has few covisible ones.
std::vector<KeyframeView> FindViews(const Map& map, const TrackedFrame& tracked) {
  std::set<KeyframeId> ids;
  if (map.FindKeyframe(tracked.reference) == nullptr) return {};
  ids.insert(tracked.reference);
  for (const Map::Covisible& covisible : map.FindCovisible(tracked.reference)) {
    if (ids.size() > kMaxKeyframes) break;
    ids.insert(covisible.keyframe);
  }
  const auto* newest = &map.keyframes().back();
  for (; newest != nullptr && ids.size() <= kMaxKeyframes;
       newest = map.keyframes().FindUpTo(newest->first - 1)) {
    ids.insert(newest->first);
  }
  std::vector<KeyframeView> views;
  for (const KeyframeId id : ids) {
    const Keyframe& keyframe = *map.FindKeyframe(id);
    views.push_back(
        {keyframe.frame.get(), keyframe.cam_from_world * tracked.cam_from_world.Inverse()});
  }
  return views;
}

// A point (metres, camera) in free space was not there when the keyframes were taken. Where they
// contradict each other, most of them are right.
Evidence ClassifyByDepth(const std::vector<KeyframeView>& views, const Eigen::Vector3d& point) {
  int balance = 0;
  for (const KeyframeView& view : views) {
    const Eigen::Vector3d in_view = view.view_from_cam * point;
    if (IsInFreeSpace(*view.frame, in_view)) {
      ++balance;
    } else if (ShowsSurface(*view.frame, in_view)) {
      --balance;
    }
  }
  return balance > 0 ? Evidence::kDynamic : balance < 0 ? Evidence::kStatic : Evidence::kNone;
}

// A feature with its depth, while the frame is being marked.
struct Candidate {
  bool* dynamic = nullptr;  // its mark
  Eigen::Vector2d pixel;
  double inverse_depth = 0.0;        // 1/metres, at the pixel
  double inverse_depth_sigma = 0.0;  // 1/metres
  bool is_inlier = false;
  int surface = DepthSurfaces::kNone;
  Evidence evidence = Evidence::kNone;
};

std::vector<Candidate> FeaturesWithDepth(const FrameMatches& inliers, Frame* frame) {
  std::vector<Candidate> candidates;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    auto& features = OfKind<L>(*frame);
    std::vector<bool> is_inlier(features.size());
    for (const auto& match : OfKind<L>(inliers)) is_inlier[match.feature] = true;
    for (size_t i = 0; i < features.size(); ++i) {
      auto& feature = features[i];
      if (!feature.HasDepth()) continue;
      candidates.push_back({&feature.dynamic, feature.Center(), feature.CenterInverseDepth(),
                            feature.CenterInverseDepthSigma(), is_inlier[i]});
    }
  });
  return candidates;
}

// Classifies a candidate. A depth that is less certain than the tolerance is inconclusive.
Evidence Classify(const std::vector<KeyframeView>& views, const PinholeCamera& camera,
                  const Candidate& candidate) {
  if (candidate.is_inlier) return Evidence::kStatic;
  if (*candidate.dynamic) return Evidence::kDynamic;
  const double tolerance = DepthRanges::kTolerance * candidate.inverse_depth;
  if (3.0 * candidate.inverse_depth_sigma > tolerance) return Evidence::kNone;
  return ClassifyByDepth(views, camera.BackProject(candidate.pixel, 1.0 / candidate.inverse_depth));
}

// The connected surface that a candidate lies on: the nearest one of its cell, or none.
int SurfaceOf(const Candidate& candidate, const DepthSurfaces& surfaces, const Frame& frame) {
  const int cell = DepthRanges::CellOf(frame.camera, candidate.pixel);
  const double nearest = frame.depth_ranges.cells[cell].max_inverse_depth;
  const double difference = std::abs(candidate.inverse_depth - nearest);
  return difference <= DepthRanges::kTolerance * nearest ? surfaces.labels[cell]
                                                         : DepthSurfaces::kNone;
}

// The surfaces with at least three dynamic features and twice as many as static ones.
std::vector<bool> DynamicSurfaces(const std::vector<Candidate>& candidates, int num_surfaces) {
  std::vector<int> num_static(num_surfaces), num_dynamic(num_surfaces);
  for (const Candidate& candidate : candidates) {
    if (candidate.surface == DepthSurfaces::kNone) continue;
    num_static[candidate.surface] += candidate.evidence == Evidence::kStatic;
    num_dynamic[candidate.surface] += candidate.evidence == Evidence::kDynamic;
  }
  std::vector<bool> dynamic(num_surfaces);
  for (int i = 0; i < num_surfaces; ++i) {
    dynamic[i] = num_dynamic[i] >= std::max(kMinDynamic, 2 * num_static[i]);
  }
  return dynamic;
}

// Marks features in free space, and all unknown ones of dynamic surfaces. Such a surface tells
// later frames nothing: its depth ranges are removed.
void MarkSurfaces(const std::vector<KeyframeView>& views, const FrameMatches& inliers,
                  Frame* frame) {
  DepthRanges& ranges = frame->depth_ranges;
  if (ranges.cells.empty()) return;
  const DepthSurfaces surfaces(ranges);
  std::vector<Candidate> candidates = FeaturesWithDepth(inliers, frame);
  for (Candidate& candidate : candidates) {
    candidate.surface = SurfaceOf(candidate, surfaces, *frame);
    candidate.evidence = Classify(views, frame->camera, candidate);
  }
  const std::vector<bool> dynamic = DynamicSurfaces(candidates, surfaces.count);
  const auto is_dynamic = [&](int surface) {
    return surface != DepthSurfaces::kNone && dynamic[surface];
  };
  for (const Candidate& candidate : candidates) {
    *candidate.dynamic = candidate.evidence == Evidence::kDynamic ||
                         (candidate.evidence == Evidence::kNone && is_dynamic(candidate.surface));
  }
  for (size_t cell = 0; cell < ranges.cells.size(); ++cell) {
    if (is_dynamic(surfaces.labels[cell])) ranges.cells[cell] = {};
  }
}

// Marks what lies in dynamic cells, except inliers.
void MarkCells(const TrackedFrame& tracked, Frame* frame) {
  if (tracked.pose.dynamic_cells.empty()) return;
  const ImageGrid grid = ConsensusGrid(frame->camera);
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    auto& features = OfKind<L>(*frame);
    for (auto& feature : features) {
      feature.dynamic = tracked.pose.dynamic_cells[grid.CellOf(feature.Center())];
    }
    for (const auto& match : OfKind<L>(tracked.matches)) features[match.feature].dynamic = false;
  });
}

}  // namespace

std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const Map& map, const TrackedFrame& tracked) {
  if (!options.enabled) return tracked.frame;
  auto marked = std::make_shared<Frame>(*tracked.frame);
  MarkCells(tracked, marked.get());
  MarkSurfaces(FindViews(map, tracked), tracked.matches, marked.get());
  return HasDynamicFeatures(*marked) ? marked : tracked.frame;
}

}  // namespace msc_vo
