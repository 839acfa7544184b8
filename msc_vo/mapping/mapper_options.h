// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/map/window_selection.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/structure/frame_structure.h"
#include "msc_vo/structure/scene_axes.h"
#include "msc_vo/structure/structural_pairs.h"

namespace msc_vo {

// Every keyframe starts where the one before it left the window, and most of the window is solved
// again at the next one. So the second solve is at its end after one step: another one lowers the
// cost by 0.03 % in the median of 195 windows, by 0.12 % in nine of ten (docs/solver.md). With one
// step in the first one as well, a corridor had 3.9 instead of 1.8 mm (docs/experiments.md).
inline BundleAdjustmentOptions MapperBundleAdjustmentOptions() {
  BundleAdjustmentOptions options;
  options.first_iterations = 2;
  options.second_iterations = 1;
  options.landmark_noise.enabled = true;
  return options;
}

// When the lines of a keyframe refine each other before they come into the map.
enum class FrameStructureUse {
  kWithoutPairs,  // where the map has no structural pairs of its own
  kAlways,
  kNever,
};

struct MapperOptions {
  // Not beside the pairs of the map: they say the same once, each keyframe would say it again,
  // as if that were news. Always instead, over 24 sequences at three times: 1.03, 0.98 and 0.99 of
  // the error, which is chance (docs/experiments.md): what costs nothing stays.
  FrameStructureUse frame_structure = FrameStructureUse::kWithoutPairs;
  FrameStructureOptions structure;
  FusionOptions fusion;
  WindowSelectionOptions selection;
  NoiseEstimatorOptions noise;
  SceneAxesOptions axes;
  StructuralPairOptions pairs;
  BundleAdjustmentOptions window = MapperBundleAdjustmentOptions();
  // Seconds from a keyframe that the window was optimised with to the next one, at least; 0: it is
  // optimised with each. Keyframes that come sooner are inserted and wait for the next window,
  // which solves most of the last one again. Four frames at 30 Hz, less some jitter: then frames
  // have seen what the last window found. Over 24 sequences, twice two runs each, errors are 1.01
  // and 1.00 times those of a window at each keyframe, kitchen takes a twelfth less time. Lines of
  // the map are off by 9.5 instead of 7.1 mm in a corridor, 8.9 instead of 9.5 in six rooms
  // (docs/experiments.md).
  double min_window_interval = 0.12;
  CullingOptions culling;
  // Of a rolling shutter, seconds (see rolling_shutter.h); 0: a global one. None: it is learnt.
  std::optional<double> readout_time;

  bool RefinesFrames() const {
    if (frame_structure != FrameStructureUse::kWithoutPairs) {
      return frame_structure == FrameStructureUse::kAlways;
    }
    return !pairs.parallel && !pairs.perpendicular;
  }
  bool IsValid(std::string* error) const;
};

}  // namespace msc_vo
