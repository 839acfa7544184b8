// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"

namespace msc_vo {

/// A window before its local bundle adjustment.
struct WindowContext {
  struct Keyframe {
    KeyframeId id = kNoId;
    double timestamp = 0.0;  ///< seconds
    Rigid3 cam_from_world;
    bool fixed = false;  ///< constant: an observer outside the window, or the gauge
  };
  /// In order of time. Keyframes are culled in the course of a run, so that those of one window may
  /// be missing in the next: factors refer to these ids only, and a factor of the motion covers the
  /// time between two keyframes of this list.
  std::vector<Keyframe> keyframes;
  /// Number of the world of the poses (FrameResult::world). A factor that constrains an absolute
  /// pose, position or direction holds in one world only.
  int world = 0;
  /// The present values of all blocks that windows have used so far, in order of their ids.
  std::vector<ExtraBlock> extra_blocks;
  std::optional<Eigen::Quaterniond> world_from_axes;  ///< the Manhattan axes, if found
  /// The window itself, before the factors of the caller are added: its points and lines, in
  /// ascending order of their ids, with their present values, and all observations. Valid during
  /// the call of WindowFactorCallback only. Factors may use any landmark in it, with
  /// BlockId::Point(id) and BlockId::Line(id). The ids are those of the map that frames are tracked
  /// in, and are never used again for another landmark. A landmark of the map is absent if no
  /// keyframe that the window optimises observes it, or one keyframe alone does, and for good if it
  /// was culled or fused with another one (the one with more observations keeps its id).
  const WindowData* data = nullptr;

  /// The landmark of `data` with this id; nullptr if the window does not contain it.
  const WindowData::Point* FindPoint(int64_t id) const;
  const WindowData::Line* FindLine(int64_t id) const;
};

/// The custom factors of a window and the extra blocks that they use. An extra block whose id was
/// used before keeps its estimated value; `manifold` and `fixed` may change.
struct WindowFactors {
  std::vector<ExtraBlock> extra_blocks;
  std::vector<CustomFactor> factors;
};

/// Called for every window before its local bundle adjustment, on the mapper's thread. The same
/// images give the same windows at any number of threads. An exception, also of an invalid factor,
/// ends the keyframe step.
using WindowFactorCallback = std::function<WindowFactors(const WindowContext&)>;

/// Describes `window`, whose keyframes are in `map`, and refers to it. Keyframes of earlier
/// sessions are left out: their time stamps mean nothing to the caller.
WindowContext MakeWindowContext(const Map& map, const WindowData& window,
                                const std::vector<ExtraBlock>& extra_blocks);

/// Fixes the gauge of every group of keyframes that neither landmarks nor custom factors link to a
/// fixed one, by its oldest keyframe. A group with custom factors, which may measure where it is,
/// gets a prior: the present pose with the covariance of the step (Map::StepCovariance). In a group
/// without factors or without that covariance, the keyframe is fixed.
void FixGaugeOfUnlinkedKeyframes(const Map& map, WindowData* window);

}  // namespace msc_vo
