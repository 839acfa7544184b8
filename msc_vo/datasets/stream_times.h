// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Returns the path of the file with the times of the images of a folder: the only one in it whose
/// name has "time" or "stamp" ("rgb/timestamps.txt"), or one beside it ("rgb_timestamps.txt");
/// empty if there is none.
std::string FindStreamTimes(const std::string& folder);

/// Pairs the images by the times of files, see TimesOfImages(), one for each stream; returns
/// whether it did. Adds a warning if a file does not fit. Either path may be empty: then it does
/// nothing.
bool PairedByStreamTimes(const std::string& color_file, const std::vector<std::string>& color,
                         const std::string& depth_file, const std::vector<std::string>& depth,
                         SequenceIndex* index);

/// Adds a warning for each text file of the folder with a line for each image whose name says that
/// it lists images or times. `used`: paths of the files that are read.
void WarnOfUnusedTimes(const std::string& folder, const std::vector<std::string>& used,
                       SequenceIndex* index);

}  // namespace msc_vo
