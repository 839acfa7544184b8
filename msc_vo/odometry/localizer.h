// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// Finds a camera in a saved map, which remains as it is: an Odometry that returns only poses
/// in the world of the map.
class Localizer {
 public:
  /// Throws std::invalid_argument on invalid options, an invalid camera, and a map without
  /// keyframes.
  Localizer(const OdometryOptions& options, const PinholeCamera& camera,
            const LensDistortion& distortion, MapContents map);

  /// Tracks one image as Odometry::Process() does. A frame that is not in the world of the map,
  /// because the camera has not been found yet or is outside of the mapped area, is lost.
  FrameResult Process(const RgbdImage& image);

  /// The poses of all frames in the world of the map, from the first one that was found there on.
  /// That frame precedes the first pose of Process() by as long as the join took to be adopted.
  OdometryResult Finish();

  /// For what is set up before the first image, such as pose factors.
  Odometry& odometry() { return odometry_; }

 private:
  Odometry odometry_;
  int num_worlds_;  // of the map
};

}  // namespace msc_vo
