// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

namespace msc_vo {

/// Sensor that measures the depth of a synthetic sequence.
enum class SyntheticDepth {
  kExact,
  kStructuredLight,
  kTimeOfFlight,
  kStereo,
  kLidar,
  kIclNuim,  ///< structured light as in the noisy sequences of ICL-NUIM
};

/// "exact", "structured-light", "tof", "stereo", "lidar" or "icl-nuim".
const char* ToString(SyntheticDepth depth);

/// The sensor with this name. "none" is exact depth, "kinect" structured light.
std::optional<SyntheticDepth> SyntheticDepthFromName(const std::string& name);

/// The names of all sensors, without other names for the same sensor.
std::vector<std::string> SyntheticDepthNames();

}  // namespace msc_vo
