// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/point_landmark.h"
#include "msc_vo/matching/viewpoint.h"

namespace msc_vo {

struct PointMatcherOptions {
  /// Largest Hamming distance, bits, between descriptors of two observations of one point.
  /// Unrelated descriptors differ in 128 +- 15 bits, somewhat less on repetitive texture.
  int max_distance = 80;
  /// Largest ratio of the best to the second best distance, unless the two are on different levels
  /// (one corner detected at two scales).
  double max_ratio = 0.9;
};

/// The match of one feature of a frame with a landmark of the map, or with a feature of another
/// frame that has a measured depth (id == kNoId).
struct PointMatch {
  int feature = 0;
  LandmarkId id = kNoId;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  bool inlier = true;
};

/// A point that is expected to be visible in a frame: a landmark, or a point of another frame that
/// has a measured depth.
struct PointCandidate {
  using Match = PointMatch;

  LandmarkId id = kNoId;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  Descriptor descriptor{};
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< predicted projection, pixels
  int level = 0;                                    ///< predicted pyramid level
};

/// The candidate of a landmark, or of a feature of another frame at `position` (metres, world),
/// without its projection. The pyramid level is that of the feature.
PointCandidate CandidateOf(const PointLandmark& point);
inline PointCandidate CandidateOf(const PointFeature& feature, LandmarkId id,
                                  const Eigen::Vector3d& position) {
  return {id, position, feature.descriptor, Eigen::Vector2d::Zero(), feature.level};
}

/// Sets the pyramid level at which a frame is expected to show a landmark.
void SetLevel(const Viewpoint& view, const PointLandmark& point, PointCandidate* candidate);

/// Projects `position`. Returns false if it lies outside the image or behind the camera.
bool ProjectCandidate(const PinholeCamera& camera, const Rigid3& cam_from_world,
                      PointCandidate* candidate);

/// Completes the candidate of a landmark. Returns whether it is expected to be visible: it projects
/// into the image, and is observed from a similar direction, at a scale that the pyramid covers.
bool IsVisible(const Viewpoint& view, const PointLandmark& point, PointCandidate* candidate);

/// Matches candidates with the features of `frame` within `radius` pixels (at level 0; scaled with
/// the level) by descriptor. A feature is matched with the candidate of smallest descriptor
/// distance, the first one on ties. Dynamic features and those with `taken[feature]` are excluded;
/// `taken` may be empty.
std::vector<PointMatch> MatchPoints(const PointMatcherOptions& options, const Frame& frame,
                                    const std::vector<PointCandidate>& candidates, double radius,
                                    const std::vector<bool>& taken);

/// Matches the static points of `from` that have a depth with those of `to` by descriptor, within
/// `radius` pixels of their projection. PointMatch::id is the index of the point in `from`.
std::vector<PointMatch> MatchFrames(const Frame& from, const Rigid3& from_cam_from_world,
                                    const Frame& to, const Rigid3& to_cam_from_world,
                                    double radius);

}  // namespace msc_vo
