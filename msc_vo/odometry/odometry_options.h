// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/surface_normals.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/odometry/snapshot_schedule.h"
#include "msc_vo/tracking/tracker_options.h"

namespace msc_vo {

/// The variants of the paper's ablation study; each one adds to the previous one.
enum class Mode {
  kPlVo,       ///< points and lines; depth of a line from its end points
  kPlVoDepth,  ///< robust depth of lines, refined by the relations of the lines of a frame
  kMscVo,      ///< Manhattan axes, and relations of lines in the map instead of in frames
};

const char* ToString(Mode mode);

/// Options of the odometry, see docs/options.md. EffectiveOptions() derives some fields of the
/// components from others; these are ignored if set.
struct OdometryOptions {
  Mode mode = Mode::kMscVo;
  bool use_points = true;
  bool use_lines = true;
  /// Warp each depth image to the time of its colour image, by the motion between the two.
  bool align_depth = true;
  /// 1: all stages in sequence. 2 or more: mapping in parallel with tracking, and that many
  /// threads for the features of an image, ten at most. The result does not depend on it.
  int threads = 2;
  /// Local mapping runs in Odometry::RunMapping(), in the thread that calls it; what is unfinished
  /// when a frame needs its map runs in Process(). The result does not depend on it.
  bool external_mapping = false;
  FrameBuilderOptions features;
  /// Seconds after which the pose of a frame is estimated again, in the map as optimised since; 0:
  /// never. A pose that pose factors took part in remains.
  double pose_refinement_delay = 5.0;
  TrackerOptions tracking;
  MapperOptions mapping;
  SnapshotOptions snapshots;

  bool IsValid(std::string* error) const;
};

/// The options in effect. Sets the fields that the mode determines, and the fields of a component
/// that must agree with those of another one:
/// - matchers of landmark fusion: those of tracking;
/// - terms, loss functions and chi-square thresholds of pose optimisation: those of local bundle
///   adjustment.
OdometryOptions EffectiveOptions(OdometryOptions options);

/// Options of the surface normals: their depth range is that of the features, up to 25 metres.
SurfaceNormalOptions NormalOptions(const OdometryOptions& options);

}  // namespace msc_vo
