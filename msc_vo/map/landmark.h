// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/frame/frame.h"
#include "msc_vo/geometry/line_segment.h"

namespace msc_vo {

using KeyframeId = int64_t;
using LandmarkId = int64_t;
constexpr int64_t kNoId = -1;

/// Feature `feature` of keyframe `keyframe` observes the landmark.
struct Observation {
  KeyframeId keyframe = kNoId;
  int feature = 0;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, keyframe, feature);
  }
};

/// Common part of point and line landmarks.
struct Landmark {
  LandmarkId id = kNoId;
  KeyframeId first_keyframe = kNoId;      ///< the keyframe that created it
  std::vector<Observation> observations;  ///< by ascending keyframe, at most one per keyframe
  Descriptor descriptor{};                ///< the observed descriptor nearest to all others
  bool descriptor_is_current = false;  ///< the observations have not changed since it was selected
  /// Mean viewing direction: unit vector in the world, from the observing cameras to the landmark.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
  /// Frames in which the landmark was predicted to be visible, and those in which it was matched.
  int num_visible = 1;
  int num_found = 1;
  /// Noise of its observations relative to the sigmas of the features.
  double noise = 1.0;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, id, first_keyframe, observations, descriptor, descriptor_is_current,
                   viewing_direction, num_visible, num_found, noise);
  }
};

/// P_i of the paper.
struct PointLandmark : Landmark {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  /// Distance (metres) at which the point's patch has the size of pyramid level 0.
  double reference_distance = 0.0;

  /// Pyramid level, not rounded, at which the point is expected from `distance` metres.
  double PredictLevel(double distance) const {
    return std::log(reference_distance / distance) / std::log(kPyramidScale);
  }

  template <typename Archive>
  void Serialize(Archive& archive) {
    Landmark::Serialize(archive);
    archive(position, reference_distance);
  }
};

/// L_j = {S_j, E_j} of the paper.
struct LineLandmark : Landmark {
  LineSegment3 segment;  ///< metres, world
  /// Standard deviation (radians) of the direction's least certain component in the best single
  /// view; pi if no view has a depth.
  double direction_sigma = 0.0;
  /// Common error (metres) of its measured depths in all views; positive: measured too far.
  double depth_offset = 0.0;

  template <typename Archive>
  void Serialize(Archive& archive) {
    Landmark::Serialize(archive);
    archive(segment, direction_sigma, depth_offset);
  }
};

}  // namespace msc_vo
