// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/synthetic_depth.h"

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

const char* ToString(SyntheticDepth depth) {
  return EnumName<SyntheticDepth::kIclNuim>(
      depth, {"exact", "structured-light", "tof", "stereo", "lidar", "icl-nuim"});
}

std::optional<SyntheticDepth> SyntheticDepthFromName(const std::string& name) {
  if (name == "none") return SyntheticDepth::kExact;
  if (name == "kinect") return SyntheticDepth::kStructuredLight;
  return EnumFromName<SyntheticDepth::kIclNuim>(name);
}

std::vector<std::string> SyntheticDepthNames() { return EnumNames<SyntheticDepth::kIclNuim>(); }

}  // namespace msc_vo
