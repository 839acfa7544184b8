// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/datasets/trajectory_format.h"

namespace msc_vo {

/// Returns the path of times.txt or timestamps.txt of a folder; empty if there is none.
std::string FindTimesFile(const std::string& directory);

/// The times of images, in ascending order.
struct ImageTimes {
  std::vector<double> seconds;
  std::vector<std::string> names;  ///< of the images; empty if the file does not name them
};

/// Reads the times of images, a line for each: the first field, or the second one if the first
/// counts the lines or is the name of the image. The first line may be a header. Throws
/// std::runtime_error naming file, line and fix if a line has no time or the times do not ascend.
ImageTimes ReadTimesFile(const std::string& path);

/// Returns the time of each image, seconds: that of the row with its name, or else of the row at
/// its position. Throws std::runtime_error, naming the file, if an image has no row or, without
/// names, the numbers of rows and images differ.
std::vector<double> TimesOfImages(const std::string& path, const std::vector<std::string>& images);

/// Gives the images of a sequence whose times are assumed those of a file, which names the colour
/// or the depth images, or has one for each colour image, each depth image or each pair. Adds a
/// warning if it does not fit.
void AdoptTimesOfFile(const std::string& path, SequenceIndex* index);

/// Gives the images of a sequence whose times are assumed those of the ground truth, pose by pose,
/// if it has a row for each colour image, depth image or pair, at ascending other times. `times`
/// are those of all rows, seconds, in ascending order, also of rows without a pose. Adds a warning,
/// also if the numbers of rows and images differ; then the ground truth is removed, unless its
/// times are those of the images. `name` is that of the file. Does nothing if the times are known.
void AdoptTimesOfTruth(const std::string& name, const std::vector<double>& times,
                       SequenceIndex* index);

/// Takes poses without time stamps as ground truth, with a warning: a row for each colour image,
/// depth image or pair. Adds only a warning if the numbers of rows and images differ. `name` is
/// that of the file.
void AssignPosesInOrder(const std::string& name, TrajectoryFile file, SequenceIndex* index);

/// Adds a warning if the times of the poses, which are as many as the images, differ from those of
/// the images by a constant: frame numbers of either may begin with 0 or 1.
void CheckTimesOfTruth(const std::string& name, SequenceIndex* index);

}  // namespace msc_vo
