// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/dynamic_features.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "msc_vo/map/depth_surfaces.h"
#include "msc_vo/map/free_space.h"
#include "msc_vo/pose_estimation/image_grid.h"

namespace msc_vo {

namespace {

// Keyframes whose depth images are consulted, apart from the reference keyframe.
constexpr size_t kMaxKeyframes = 20;

// What is known of a feature's surface.
enum class Evidence { kNone, kStatic, kDynamic };

// A keyframe that has seen the same space.
struct Witness {
  const Frame* frame = nullptr;
  Rigid3 witness_from_cam;
};

std::vector<Witness> FindWitnesses(const Map& map, const TrackedFrame& tracked) {
  std::vector<Witness> witnesses;
  const auto add = [&](const Keyframe& keyframe) {
    witnesses.push_back(
        {keyframe.frame.get(), keyframe.cam_from_world * tracked.cam_from_world.Inverse()});
  };
  const Keyframe* reference = map.FindKeyframe(tracked.reference);
  if (reference == nullptr) return witnesses;
  add(*reference);
  for (const Map::Covisible& covisible : map.FindCovisible(tracked.reference)) {
    if (witnesses.size() > kMaxKeyframes) break;
    add(*map.FindKeyframe(covisible.keyframe));
  }
  return witnesses;
}

// A point (metres, camera) that was looked through was not there; one that was seen is still there.
Evidence Judge(const std::vector<Witness>& witnesses, const Eigen::Vector3d& point) {
  Evidence evidence = Evidence::kNone;
  for (const Witness& witness : witnesses) {
    const Eigen::Vector3d in_witness = witness.witness_from_cam * point;
    if (LooksThrough(*witness.frame, in_witness)) return Evidence::kDynamic;
    if (ShowsSurface(*witness.frame, in_witness)) evidence = Evidence::kStatic;
  }
  return evidence;
}

// A feature with its depth, while the frame is being marked.
struct Candidate {
  bool* dynamic = nullptr;  // its mark
  Eigen::Vector2d pixel;
  Eigen::Vector3d point;  // metres, camera
  bool is_inlier = false;
  Evidence evidence = Evidence::kNone;
};

std::vector<Candidate> FeaturesWithDepth(const FrameMatches& inliers, Frame* frame) {
  std::vector<Candidate> candidates;
  std::vector<bool> point_is_inlier(frame->points.size()), line_is_inlier(frame->lines.size());
  for (const PointMatch& match : inliers.points) point_is_inlier[match.feature] = true;
  for (const LineMatch& match : inliers.lines) line_is_inlier[match.feature] = true;
  for (size_t i = 0; i < frame->points.size(); ++i) {
    PointFeature& point = frame->points[i];
    if (!point.HasDepth()) continue;
    candidates.push_back({&point.dynamic, point.pixel, frame->PointInCamera(static_cast<int>(i)),
                          point_is_inlier[i]});
  }
  for (size_t i = 0; i < frame->lines.size(); ++i) {
    LineFeature& line = frame->lines[i];
    if (!line.depth) continue;
    const LineSegment3 segment = frame->LineInCamera(static_cast<int>(i));
    candidates.push_back(
        {&line.dynamic, line.segment.Midpoint(), segment.Midpoint(), line_is_inlier[i]});
  }
  return candidates;
}

// Marks features in free space, and all unknown ones of a surface of which more is known to be
// dynamic than static. Such a surface tells later frames nothing: its depth ranges are removed.
void MarkSurfaces(const std::vector<Witness>& witnesses, const FrameMatches& inliers,
                  Frame* frame) {
  DepthRanges& ranges = frame->depth_ranges;
  const DepthSurfaces surfaces(ranges);
  if (surfaces.count == 0) return;
  const auto surface_of = [&](const Candidate& candidate) {
    const int cell = DepthRanges::CellOf(frame->camera, candidate.pixel);
    const double ratio = candidate.point.z() * ranges.cells[cell].max_inverse_depth;
    const bool is_nearest = std::abs(ratio - 1.0) <= DepthRanges::kTolerance;
    return is_nearest ? surfaces.of_cell[cell] : DepthSurfaces::kNone;
  };
  std::vector<Candidate> candidates = FeaturesWithDepth(inliers, frame);
  std::vector<int> balance(surfaces.count);  // dynamic minus static features
  for (Candidate& candidate : candidates) {
    candidate.evidence = candidate.is_inlier  ? Evidence::kStatic
                         : *candidate.dynamic ? Evidence::kDynamic
                                              : Judge(witnesses, candidate.point);
    *candidate.dynamic = candidate.evidence == Evidence::kDynamic;
    const int surface = surface_of(candidate);
    if (surface == DepthSurfaces::kNone || candidate.evidence == Evidence::kNone) continue;
    balance[surface] += *candidate.dynamic ? 1 : -1;
  }
  for (Candidate& candidate : candidates) {
    const int surface = surface_of(candidate);
    if (surface == DepthSurfaces::kNone || candidate.evidence != Evidence::kNone) continue;
    *candidate.dynamic = balance[surface] > 0;
  }
  for (size_t cell = 0; cell < ranges.cells.size(); ++cell) {
    const int surface = surfaces.of_cell[cell];
    if (surface != DepthSurfaces::kNone && balance[surface] > 0) ranges.cells[cell] = {};
  }
}

void MarkCells(const CellConsensusOptions& options, const std::vector<bool>& dynamic_cells,
               Frame* frame) {
  if (dynamic_cells.empty()) return;
  const ImageGrid grid(options.columns, options.rows, frame->camera);
  for (PointFeature& point : frame->points) point.dynamic = dynamic_cells[grid.CellOf(point.pixel)];
  for (LineFeature& line : frame->lines) line.dynamic = dynamic_cells[grid.CellOf(line.segment)];
}

void Unmark(const FrameMatches& inliers, Frame* frame) {
  for (const PointMatch& match : inliers.points) frame->points[match.feature].dynamic = false;
  for (const LineMatch& match : inliers.lines) frame->lines[match.feature].dynamic = false;
}

bool HasDynamicFeatures(const Frame& frame) {
  const auto is_dynamic = [](const auto& feature) { return feature.dynamic; };
  return std::any_of(frame.points.begin(), frame.points.end(), is_dynamic) ||
         std::any_of(frame.lines.begin(), frame.lines.end(), is_dynamic);
}

}  // namespace

std::shared_ptr<const Frame> MarkDynamicFeatures(const CellConsensusOptions& options,
                                                 const Map& map, const TrackedFrame& tracked) {
  if (!options.enabled) return tracked.frame;
  auto marked = std::make_shared<Frame>(*tracked.frame);
  MarkCells(options, tracked.dynamic_cells, marked.get());
  MarkSurfaces(FindWitnesses(map, tracked), tracked.matches, marked.get());
  Unmark(tracked.matches, marked.get());
  return HasDynamicFeatures(*marked) ? marked : tracked.frame;
}

}  // namespace msc_vo
