// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// Returns the full paths of the image files (PNG, JPEG and others) of a folder in the order of
/// their names, see SortNames(). `prefix` and `suffix` select names by their beginning and by the
/// end of their stem. JPEG copies of images of another format are left out. Empty if the folder
/// does not exist.
std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix = "",
                                    const std::string& suffix = "");

/// What the images of a folder are.
enum class FolderImages {
  kNone,   ///< there are none, or they cannot be read
  kColor,  ///< 8 bits, several channels
  kDepth,  ///< one channel of more than 8 bits
  kOther,
};

/// Determines what the images of a folder are by its first one.
FolderImages FindFolderImages(const std::string& folder);

}  // namespace msc_vo
