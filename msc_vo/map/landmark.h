// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/frame/descriptor.h"

namespace msc_vo {

using KeyframeId = int64_t;
using LandmarkId = int64_t;
constexpr int64_t kNoId = -1;

/// Feature `feature` of keyframe `keyframe` observes the landmark.
struct Observation {
  KeyframeId keyframe = kNoId;
  int feature = 0;
};

/// Common part of all kinds of landmarks.
///
/// A kind is a struct that derives from Landmark (point_landmark.h, line_landmark.h) and defines
/// what differs between kinds, with the same names in each. Code that is the same for all kinds is
/// a template over that struct; landmark_kinds.h lists the kinds.
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
  /// The depth image measured a nearer surface, such as a pane of glass; only the observations in
  /// the image are used.
  bool has_false_depth = false;
};

}  // namespace msc_vo
