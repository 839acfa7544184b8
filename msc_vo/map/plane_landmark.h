// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "msc_vo/geometry/plane.h"
#include "msc_vo/geometry/plane_extent.h"
#include "msc_vo/map/landmark.h"

namespace msc_vo {

/// A plane of the map.
struct PlaneLandmark {
  LandmarkId id = kNoId;
  Plane plane;              ///< world
  PlaneExtent extent = {};  ///< convex hull of its observations, world
};

/// The planes of a map, as a snapshot has them.
struct MapPlanes {
  std::vector<PlaneLandmark> planes;  ///< in order of their ids
  double noise = 1.0;                 ///< scale of the sigmas of plane features, self-calibrated
  int64_t numbering = 0;              ///< ids of another numbering are those of other planes

  /// Returns nullptr if there is none.
  const PlaneLandmark* Find(LandmarkId id) const {
    const auto found =
        std::lower_bound(planes.begin(), planes.end(), id,
                         [](const PlaneLandmark& plane, LandmarkId x) { return plane.id < x; });
    return found == planes.end() || found->id != id ? nullptr : &*found;
  }
};

/// The plane feature of a frame is a plane of the map.
struct PlaneMatch {
  int feature = -1;
  LandmarkId plane = kNoId;
};

/// A plane in the camera frame of a keyframe that observed it, its host, with which it moves when
/// the map is corrected.
struct HostedPlane {
  KeyframeId host = kNoId;
  Plane in_host;
  PlaneExtent extent = {};  ///< host frame; near the plane, which may have moved since
};

/// The planes of a map, as a map file keeps them.
struct SavedPlanes {
  std::map<LandmarkId, HostedPlane> planes;  ///< with a host that is in the map
  /// By keyframe; every plane has an observation.
  std::map<KeyframeId, std::vector<PlaneMatch>> observations;
  double noise = 1.0;  ///< MapPlanes::noise
};

}  // namespace msc_vo
