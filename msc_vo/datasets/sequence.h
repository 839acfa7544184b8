// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

// One RGB-D image of a sequence: where it lies.
struct SequenceEntry {
  double timestamp = 0.0;  // seconds
  std::string color_path;
  std::string depth_path;
  std::string origin;  // what named the pair: "rgb.txt:12"; empty: the listing of a folder
  // Seconds from the colour image to the depth image, as far as their stamps tell.
  double depth_delay = 0.0;
};

// What a folder holds. Nothing of the images has been decoded yet.
struct SequenceIndex {
  std::string format;                        // name of the layout, "tum"
  std::string directory;                     // without a trailing slash
  std::vector<SequenceEntry> entries;        // in order of time, stamps unique
  TimeUnit stamp_unit = TimeUnit::kSeconds;  // of the images' stamps, as the folder gives them
  // From a file of the folder. Describes images of the depth's size.
  std::optional<Calibration> calibration;
  std::string preset;        // camera preset that the layout or the name suggests; may be empty
  int invalid_depth = 0;     // raw depth value that means "no measurement", beside 0
  bool scale_color = false;  // colour is larger than depth and is scaled down to its size
  std::vector<TimedPose> ground_truth;  // in order of time; empty: the folder has none
  std::vector<std::string> warnings;    // for the user, one sentence each
};

// Names that OpenSequence takes as `format`, apart from "auto".
std::vector<std::string> SequenceFormatNames();

// Finds out what is in a folder. `format` is "auto" or one of SequenceFormatNames().
// Throws std::runtime_error naming file, line and fix if the folder is no sequence, a list or a
// ground truth is malformed, or no image is left; std::invalid_argument on an unknown format.
SequenceIndex OpenSequence(const std::string& directory, const std::string& format = "auto");

// The folder of the sequence and those that its images lie in.
std::vector<std::string> InputFolders(const SequenceIndex& index);

}  // namespace msc_vo
