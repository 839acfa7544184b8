// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// Returns the folder of depth images of a sequence, or with the ending ".txt" their list: the
/// first one whose name says that depth is registered to colour, such as aligned_depth or
/// depth_registered, or else "depth", "depths", "depth_images", "depth_left" or "lowres_depth";
/// empty if there is none. Case does not matter. Adds a warning if there are both.
std::string FindDepth(const std::string& directory, const std::string& ending,
                      std::vector<std::string>* warnings = nullptr);

/// Returns the folder of colour images of a sequence: "rgb", "color", "image" and the like; empty
/// if there is none.
std::string FindColorFolder(const std::string& directory);

/// Returns rgb.txt or color.txt of a folder; empty if there is none.
std::string FindColorList(const std::string& directory);

}  // namespace msc_vo
