// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// What to give instead of a map where a trajectory is expected.
inline constexpr char kNoTrajectory[] =
    "give a trajectory: that of a run, or of the keyframes of the map, which msc_vo map export "
    "writes";

/// Throws std::runtime_error if `path` is a map file, which is not what a command expects. `fix`:
/// what to give instead.
void RefuseMapFile(const std::string& path, const std::string& fix);

}  // namespace msc_vo
