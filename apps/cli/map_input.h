// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// Reads a map that must have keyframes. Throws as LoadMap(), and std::runtime_error if it has
/// none.
MapContents LoadKeyframes(const std::string& path);

}  // namespace msc_vo
