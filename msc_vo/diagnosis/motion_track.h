// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/edge_alignment.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

/// An image that the odometry has tracked.
struct MotionImage {
  double timestamp = 0.0;  ///< seconds
  /// Images of one segment have a common world; a segment is one of the odometry.
  int segment = 0;
  Rigid3 cam_from_world;
  bool linked = false;        ///< the image before is in the same segment and shares map points
  double displacement = 0.0;  ///< if linked: median of the map points since then, pixels
  /// If linked: median of the map points since then, pixels/second.
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  EdgeAlignment edges;       ///< of depth and colour
  double depth_delay = 0.0;  ///< seconds, as the stamps say
};

/// Two images of a segment up to 1.5 s apart.
struct MotionPair {
  int from = 0;  ///< index in MotionTrack::images
  int to = 0;
};

/// Motion of the camera over stretches of a sequence, as the odometry finds it with the given
/// calibration.
struct MotionTrack {
  int num_images = 0;  ///< that the odometry processed
  /// Images with a weak pose, whose errors may be as large as the motion: they take no part.
  int num_weak = 0;
  std::vector<MotionImage> images;  ///< with a tracked pose, in order of time
  /// Pairs with as much rotation as their common view permits, in order of time.
  std::vector<MotionPair> pairs;
  /// What a calibration is estimated from, as of CalibrationRounds: images of each stretch, and
  /// SelfCalibratingBundleAdjustment() of their maps.
  std::vector<CalibrationSequence> views;
  CalibrationInformation of_maps;
  std::vector<NoiseScale> noise_scales;  ///< at the end of each stretch

  /// Maps coordinates of the first camera of a pair to the second one.
  Rigid3 MotionOf(const MotionPair& pair) const {
    return images[pair.to].cam_from_world * images[pair.from].cam_from_world.Inverse();
  }
};

/// Runs the odometry on at most `max_images` images in up to four stretches of consecutive images.
/// Images that it refuses are left out; the check of the images reports them.
MotionTrack TrackMotion(const RgbdDecoder& decoder, const OdometryOptions& options, int max_images);

}  // namespace msc_vo
