// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "apps/cli/replay_arguments.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Tests the files that a run writes (results in `output`, map, video, log, exports) before any of
/// them is opened. Throws std::runtime_error that names the option if two of them have the same
/// path, if one has that of the map that is only read, or if the video would be written over
/// another input.
void RefuseSharedPaths(const ReplayArguments& arguments, const SequenceIndex& sequence,
                       const std::string& output);

}  // namespace msc_vo
