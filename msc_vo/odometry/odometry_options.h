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

// The paper's ablation: each mode adds a contribution.
enum class Mode {
  kPlVo,       // points and lines, depth of a line from its end points
  kPlVoDepth,  // + robust line depth, lines of a frame refined by their relations
  kMscVo,      // + Manhattan axes, and relations of lines in the map instead of in frames
};

const char* ToString(Mode mode);
// "pl-vo", "pl-vo-depth", "msc-vo". Throws std::invalid_argument naming the choices otherwise.
Mode ModeFromString(const std::string& name);

struct OdometryOptions {
  Mode mode = Mode::kMscVo;
  bool use_points = true;
  bool use_lines = true;
  // Depth images are moved to the time of their colour image, as the camera moved in between.
  bool align_depth = true;
  // Processors to make use of. 1: everything in turn; 2 or more: mapping beside tracking, points
  // beside lines. The result is the same for any number.
  int threads = 2;
  FrameBuilderOptions features;
  SurfaceNormalOptions normals;
  TrackerOptions tracking;
  MapperOptions mapping;
  SnapshotOptions snapshots;

  bool IsValid(std::string* error) const;
};

// The options as they take effect: what the mode decides is as it decides.
OdometryOptions WithModeApplied(OdometryOptions options);

}  // namespace msc_vo
