// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

namespace msc_vo {

/// Returns the full paths of the image files (PNG, JPEG and others) of a folder in natural order of
/// their names, see NaturalLess(). `prefix` and `suffix` select names by their beginning and by the
/// end of their stem. JPEG copies of images of another format are left out. Empty if the folder
/// does not exist.
std::vector<std::string> ListImages(const std::string& folder, const std::string& prefix = "",
                                    const std::string& suffix = "");

}  // namespace msc_vo
