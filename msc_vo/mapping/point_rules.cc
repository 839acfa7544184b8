// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/point_rules.h"

#include <cmath>
#include <limits>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

std::vector<PointCandidate> PointsOf(const Map& map, const Keyframe& source,
                                     const Keyframe& target) {
  std::vector<PointCandidate> candidates;
  const Eigen::Vector3d center = target.cam_from_world.OriginInSource();
  for (const LandmarkId id : source.points) {
    const PointLandmark* point = map.Find<PointLandmark>(id);
    if (point == nullptr || FindObservation(*point, target.id) != nullptr) continue;
    PointCandidate candidate;
    candidate.id = id;
    candidate.position = point->position;
    candidate.descriptor = point->descriptor;
    const double level = point->PredictLevel((point->position - center).norm());
    candidate.level = CellIndex(std::round(level), std::numeric_limits<int>::max());
    if (ProjectCandidate(target.frame->camera, target.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

}  // namespace

std::vector<PointMatch> MatchForFusion(LandmarkKind<PointLandmark> /*kind*/,
                                       const FusionOptions& options, const Map& map,
                                       const Keyframe& source, const Keyframe& target) {
  return MatchPoints(options.point_matcher, *target.frame, PointsOf(map, source, target),
                     kFusionRadius, {});
}

// At the 99 % quantile.
bool AgreesWithDepth(const Keyframe& keyframe, int feature, const PointLandmark& point) {
  const PointFeature& measured = keyframe.frame->points[feature];
  if (!measured.HasDepth()) return true;
  const double depth = (keyframe.cam_from_world * point.position).z();
  return depth > 0.0 &&
         std::abs(1.0 / depth - measured.inverse_depth) < 2.576 * measured.inverse_depth_sigma;
}

bool AreDuplicates(const Keyframe& /*keyframe*/, const PointLandmark& /*a*/,
                   const PointLandmark& /*b*/) {
  return true;  // both project to the feature, at its depth
}

}  // namespace msc_vo
