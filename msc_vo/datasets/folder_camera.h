// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Reads camera.txt of the folder if it exists.
void ReadFolderCamera(const std::string& directory, SequenceIndex* index);

/// Depth scale of the images of a layout.
struct LayoutDepthScale {
  double units_per_metre = 0.0;
  bool is_certain = false;  ///< part of the layout; otherwise its usual value
};

/// Takes the camera from a file of another program in the folder or, unless the name of the folder
/// is that of a published sequence, in its parent, see ReadIntrinsicsFile(). Does nothing if the
/// index has a calibration, or if there is no such file, or several with different cameras. If the
/// file gives no depth scale, it is that of the layout, with a warning if that is uncertain. Throws
/// std::runtime_error if a file of the folder describes the camera of images of another size. The
/// entries must be known.
void ReadThirdPartyCamera(const std::string& directory, const LayoutDepthScale& depth_scale,
                          SequenceIndex* index);

/// Returns the paths of the files of FindCalibrationFiles() in the folder or, if there are none, in
/// its parent; empty for a recording in one file.
std::vector<std::string> CalibrationFilesNear(const std::string& directory);

}  // namespace msc_vo
