// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_options.h"

#include <stdexcept>

#include "msc_vo/odometry/option.h"

namespace msc_vo {

const char* ToString(Mode mode) {
  switch (mode) {
    case Mode::kPlVo:
      return "pl-vo";
    case Mode::kPlVoDepth:
      return "pl-vo-depth";
    case Mode::kMscVo:
      return "msc-vo";
  }
  return "unknown";
}

Mode ModeFromString(const std::string& name) {
  for (const Mode mode : {Mode::kPlVo, Mode::kPlVoDepth, Mode::kMscVo}) {
    if (name == ToString(mode)) return mode;
  }
  throw std::invalid_argument("unknown mode '" + name + "': choose pl-vo, pl-vo-depth or msc-vo");
}

bool OdometryOptions::IsValid(std::string* error) const {
  if (!use_points && !use_lines) {
    *error = "options: use_points and use_lines must not both be off";
    return false;
  }
  OdometryOptions copy = *this;  // the list points to what can be set
  if (!AreInRange(ListOptions(&copy), error)) return false;
  return features.IsValid(error) && normals.IsValid(error) && tracking.IsValid(error) &&
         mapping.IsValid(error) && snapshots.IsValid(error);
}

OdometryOptions WithModeApplied(OdometryOptions options) {
  if (options.mode == Mode::kPlVo) {
    options.features.line_depth = LineDepthMethod::kEndPoints;
    options.mapping.frame_structure = FrameStructureUse::kNever;
  }
  if (options.mode != Mode::kMscVo) {
    options.mapping.pairs.parallel = false;
    options.mapping.pairs.perpendicular = false;
    options.mapping.axes.enabled = false;
  }
  return options;
}

}  // namespace msc_vo
