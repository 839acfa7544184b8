// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/map/window_selection.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/self_calibration/noise_estimator.h"
#include "msc_vo/structure/frame_structure.h"
#include "msc_vo/structure/scene_axes.h"
#include "msc_vo/structure/structural_pairs.h"

namespace msc_vo {

/// Options of local bundle adjustment for the mapper. Consecutive windows overlap, so that each
/// starts near its optimum and few iterations suffice. Chosen by measurement, see
/// docs/lab/bundle_adjustment.md.
inline BundleAdjustmentOptions MapperBundleAdjustmentOptions() {
  BundleAdjustmentOptions options;
  options.first_iterations = 2;
  options.second_iterations = 1;
  options.landmark_noise.enabled = true;
  options.consensus.enabled = false;
  return options;
}

struct MapperOptions {
  /// Whether the lines of a keyframe refine each other before they enter the map.
  bool frame_structure = true;
  FrameStructureOptions structure;
  FusionOptions fusion;
  WindowSelectionOptions selection;
  NoiseEstimatorOptions noise;
  SceneAxesOptions axes;
  StructuralPairOptions pairs;
  BundleAdjustmentOptions window = MapperBundleAdjustmentOptions();
  /// Smallest interval between keyframes with local bundle adjustment, seconds; 0: after every
  /// keyframe. Keyframes in between are inserted and optimised with the next window. The default is
  /// four frames at 30 Hz less some jitter, after which frames have been tracked against the map of
  /// the last window. Chosen by measurement, see docs/lab/bundle_adjustment.md.
  double min_window_interval = 0.12;
  CullingOptions culling;
  /// Whether focal length, principal point and radial distortion are corrected if the images
  /// contradict them.
  bool self_calibration = true;
  /// Readout time of the rolling shutter, seconds (see rolling_shutter.h); 0: global shutter. None:
  /// it is estimated.
  std::optional<double> readout_time;

  /// Whether windows contain structural terms.
  bool MapHasStructure() const { return axes.enabled || pairs.parallel || pairs.perpendicular; }
};

}  // namespace msc_vo
