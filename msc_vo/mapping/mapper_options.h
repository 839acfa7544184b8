// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/map/window.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/mapping/noise_estimator.h"
#include "msc_vo/mapping/scene_axes.h"
#include "msc_vo/mapping/structural_pairs.h"
#include "msc_vo/problems/frame_structure_problem.h"
#include "msc_vo/problems/window_problem.h"

namespace msc_vo {

// Every keyframe starts where the one before it left the window, and most of the window is solved
// again at the next one. A third of the steps that it may take from anywhere change no error over
// all sequences, and take half the time of a keyframe (docs/performance.md). Fewer do: with 2 + 3,
// 2 + 2, 1 + 3 and 1 + 2, three runs each of 24 sequences, 0.92, 0.93, 0.96 and 0.97 mm, and with
// 2 + 2 map lines of the corridor err by 0.98 instead of 0.15 degrees (RMSE, six runs; few lines).
inline WindowOptions LocalWindowOptions() {
  WindowOptions options;
  options.first_iterations = 2;
  options.second_iterations = 3;
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
  // as if that were news. Always, and only without pairs, three runs each of 24 sequences: 0.95 and
  // 0.92 mm; living 0.51 and 0.43.
  FrameStructureUse frame_structure = FrameStructureUse::kWithoutPairs;
  FrameStructureOptions structure;
  FusionOptions fusion;
  WindowSelectionOptions selection;
  NoiseEstimatorOptions noise;
  SceneAxesOptions axes;
  StructuralPairOptions pairs;
  WindowOptions window = LocalWindowOptions();
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
