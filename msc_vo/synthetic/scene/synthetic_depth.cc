// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/synthetic_depth.h"

namespace msc_vo {

namespace {

constexpr SyntheticDepth kAll[] = {SyntheticDepth::kExact,        SyntheticDepth::kStructuredLight,
                                   SyntheticDepth::kTimeOfFlight, SyntheticDepth::kStereo,
                                   SyntheticDepth::kLidar,        SyntheticDepth::kIclNuim};

}  // namespace

const char* ToString(SyntheticDepth depth) {
  switch (depth) {
    case SyntheticDepth::kExact:
      return "exact";
    case SyntheticDepth::kStructuredLight:
      return "structured-light";
    case SyntheticDepth::kTimeOfFlight:
      return "tof";
    case SyntheticDepth::kStereo:
      return "stereo";
    case SyntheticDepth::kLidar:
      return "lidar";
    case SyntheticDepth::kIclNuim:
      return "icl-nuim";
  }
  return "unknown";
}

std::optional<SyntheticDepth> SyntheticDepthFromName(const std::string& name) {
  for (const SyntheticDepth depth : kAll) {
    if (name == ToString(depth)) return depth;
  }
  if (name == "none") return SyntheticDepth::kExact;
  if (name == "kinect") return SyntheticDepth::kStructuredLight;
  return std::nullopt;
}

std::vector<std::string> SyntheticDepthNames() {
  std::vector<std::string> names;
  for (const SyntheticDepth depth : kAll) names.emplace_back(ToString(depth));
  return names;
}

}  // namespace msc_vo
