// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace msc_vo {

/// A line of camera.txt that identifies folders written by `msc_vo synthesize`.
inline constexpr char kSynthesizedMark[] = "written by msc_vo synthesize";

/// The key of the options of the command in truth.json.
inline constexpr char kSynthesizedOptions[] = "options";

/// Creates `folder` with rgb/ and depth/ for a sequence that is rendered with `options`, values by
/// name. Removes the images of an earlier sequence of the command, which are named by their time
/// stamps; other files are kept. Throws std::runtime_error unless the folder is empty, does not
/// exist, or holds a sequence of the same options without further images; with `overwrite`, it may
/// hold anything.
void PrepareSequenceFolder(const std::filesystem::path& folder,
                           const std::map<std::string, std::string>& options, bool overwrite);

}  // namespace msc_vo
