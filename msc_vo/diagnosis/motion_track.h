// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/edge_alignment.h"
#include "msc_vo/diagnosis/frame_motion.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/sensor/inverse_depth_image.h"

namespace msc_vo {

/// An image whose motion from its predecessor is known.
struct MotionImage {
  double timestamp = 0.0;  ///< seconds
  std::shared_ptr<const Frame> frame;
  /// Depth at the time of the colour image; kept of about 80 images, null in the others.
  std::shared_ptr<const InverseDepthImage> depth;
  /// Images of one segment are linked by motions; a segment ends where an image does not match.
  int segment = 0;
  Rigid3 cam_from_origin;     ///< origin: the camera at the begin of the segment
  bool linked = false;        ///< to the image before; the fields below are meaningful only then
  double displacement = 0.0;  ///< median of the points, pixels
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< median of the points, pixels/second
  CameraVelocity camera_velocity;                      ///< zero if unknown
  EdgeAlignment edges;                                 ///< of depth and colour
  double depth_delay = 0.0;                            ///< seconds, as the stamps say
};

/// Two images up to 1.5 s apart with their relative pose.
struct MotionPair {
  int from = 0;  ///< index in MotionTrack::images
  int to = 0;
  FrameMotion motion;
};

/// Motion of the camera over stretches of a sequence, from one image to the next: no map, no
/// optimisation, and no assumption about the calibration beyond that points are found again.
struct MotionTrack {
  std::vector<MotionImage> images;
  int num_pairs = 0;   ///< pairs of consecutive images
  int num_linked = 0;  ///< pairs of consecutive images that match
  /// Pairs with as much rotation as their common view permits, in order of time.
  std::vector<MotionPair> pairs;
};

/// Tracks at most `max_images` images in up to four stretches of consecutive images.
MotionTrack TrackMotion(const RgbdDecoder& decoder, const FrameBuilderOptions& features,
                        int max_images);

}  // namespace msc_vo
