// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Returns the path of times.txt or timestamps.txt of a folder; empty if there is none.
std::string FindTimesFile(const std::string& directory);

/// Reads the times of images, a line for each: the first number, or the second one if the first
/// counts the lines. Returns seconds. Throws std::runtime_error naming file, line and fix if a line
/// has no time or the times do not ascend.
std::vector<double> ReadTimesFile(const std::string& path);

/// Gives the images of a sequence whose times are assumed those of the file of FindTimesFile().
/// Adds a warning if there is such a file that does not fit.
void AdoptTimesOfFile(const std::string& directory, SequenceIndex* index);

/// Gives the images of a sequence whose times are assumed those of the ground truth, pose by pose,
/// if it has a pose for each of them, at ascending other times. Adds a warning, also if the numbers
/// of poses and images differ. `name` is that of the file. Does nothing if the times are known.
void AdoptTimesOfTruth(const std::string& name, SequenceIndex* index);

/// Adds a warning if the times of the poses, which are as many as the images, differ from those of
/// the images by a constant: frame numbers of either may begin with 0 or 1.
void CheckTimesOfTruth(const std::string& name, SequenceIndex* index);

}  // namespace msc_vo
