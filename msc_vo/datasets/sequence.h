// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

/// The files of one RGB-D image of a sequence.
struct SequenceEntry {
  double timestamp = 0.0;  ///< seconds
  std::string color_path;
  std::string depth_path;
  std::string origin;  ///< list that names the pair, "rgb.txt:12"; empty: found in a folder
  /// Seconds from the colour image to the depth image; 0 if their stamps are on different clocks.
  double depth_delay = 0.0;
};

/// The contents of a sequence folder; images are not decoded.
struct SequenceIndex {
  std::string format;                        ///< name of the layout, "tum"
  std::string directory;                     ///< without trailing slash
  std::vector<SequenceEntry> entries;        ///< in order of time, stamps unique
  TimeUnit stamp_unit = TimeUnit::kSeconds;  ///< original unit of the image stamps
  /// Calibration file of the folder; for images of the size of depth.
  std::optional<Calibration> calibration;
  std::string preset;        ///< camera preset guessed from the layout or the name; may be empty
  int invalid_depth = 0;     ///< raw depth value for "no measurement", in addition to 0
  bool scale_color = false;  ///< colour is larger than depth and is scaled down to its size
  std::vector<TimedPose> ground_truth;  ///< in order of time; empty: there is none
  std::vector<std::string> warnings;    ///< for the user, one sentence each
};

/// Returns the names that OpenSequence() accepts as `format`, except "auto".
std::vector<std::string> SequenceFormatNames();

/// Reads the lists and the ground truth of a sequence folder. `format` is "auto" or one of
/// SequenceFormatNames().
/// Throws std::runtime_error naming file, line and fix if the folder is not a sequence, a list or
/// the ground truth is malformed, or there is no pair of images; std::invalid_argument on an
/// unknown format.
SequenceIndex OpenSequence(const std::string& directory, const std::string& format = "auto");

/// Returns the folder of the sequence and the folders of its images.
std::vector<std::string> InputFolders(const SequenceIndex& index);

}  // namespace msc_vo
