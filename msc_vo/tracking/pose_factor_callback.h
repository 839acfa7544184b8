// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <vector>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/pose_estimation/pose_factor.h"

namespace msc_vo {

/// A frame before its pose is estimated. Poses are in the present map.
struct FrameContext {
  double timestamp = 0.0;  ///< seconds
  /// The last frame whose pose was estimated from its image, or that began a new part of the map.
  /// Frames in between have no image, or one that yields no pose, so that the interval may be much
  /// longer than that of the frames: a factor of the motion covers all of it, with the uncertainty
  /// of all of it.
  double last_timestamp = 0.0;  ///< seconds
  Rigid3 last_cam_from_world;
  Rigid3 predicted_cam_from_world;  ///< of this frame, by constant velocity
  /// Number of the world of these poses (FrameResult::world). A factor that constrains an absolute
  /// pose, position or direction holds in one world only.
  int world = 0;
  /// The extra blocks of the window factors as estimated in the map that the frame is tracked in,
  /// in order of their ids; none before a window has estimated them. Their manifolds may be null.
  std::vector<ExtraBlock> extra_blocks;
};

/// Called once for every frame, except before the first keyframe, and returns factors over its
/// pose; they may be none. The same frames and maps give the same contexts at any number of
/// threads.
using PoseFactorCallback = std::function<std::vector<PoseFactor>(const FrameContext&)>;

}  // namespace msc_vo
