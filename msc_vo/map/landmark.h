// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/map/frame.h"

namespace msc_vo {

using KeyframeId = int64_t;
using LandmarkId = int64_t;
constexpr int64_t kNoId = -1;

// Feature `feature` of keyframe `keyframe` shows the landmark.
struct Observation {
  KeyframeId keyframe = kNoId;
  int feature = 0;
};

// What point and line landmarks have in common.
struct Landmark {
  LandmarkId id = kNoId;
  KeyframeId first_keyframe = kNoId;      // the one that created it
  std::vector<Observation> observations;  // ascending keyframes, one each at most
  Descriptor descriptor{};                // the observed one nearest to all others
  bool descriptor_is_current = false;     // no observation has come or gone since it was chosen
  // Unit vector, mean of the directions from the observing cameras to the landmark, world.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
  // Frames in which the landmark should have been seen, and those in which it was.
  int num_visible = 1;
  int num_found = 1;
  // How many times larger the errors of its observations are than the sigmas of its features.
  double noise = 1.0;
};

// P_i of the paper.
struct PointLandmark : Landmark {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
  // Distance (metres) at which the point's patch has the size of pyramid level 0; the level seen at
  // distance d is log(reference_distance / d) / log(scale).
  double reference_distance = 0.0;
};

// L_j = {S_j, E_j} of the paper.
struct LineLandmark : Landmark {
  LineSegment3 segment;  // metres, world
  // Radians, of the direction in its least certain component, as the best single view knows it; pi
  // if no view has a depth.
  double direction_sigma = 0.0;
  // Metres by which its depths are measured too far, in all views alike.
  double depth_offset = 0.0;
};

}  // namespace msc_vo
