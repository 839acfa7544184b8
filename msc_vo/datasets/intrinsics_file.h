// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/image_files/image_file.h"

namespace msc_vo {

/// The pinhole camera in a file of another program.
struct GivenIntrinsics {
  std::string path;
  PinholeCamera camera;               ///< width and height are 0 if the file does not give them
  std::optional<double> depth_scale;  ///< raw depth units per metre
};

/// Reads the intrinsics in a file: the numbers "fx fy cx cy", a 3x3, 3x4 or 4x4 camera matrix
/// without skew, or JSON with the keys of NICE-SLAM ("camera": fx, fy, cx, cy, w, h, scale),
/// Open3D (intrinsic_matrix column by column, width, height) or nerfstudio (fl_x, fl_y, cx, cy, w,
/// h; without distortion; the centre of the first pixel is at 0.5). A depth scale may also be in
/// "depth_scale". None if the file holds anything else or cannot be read.
std::optional<GivenIntrinsics> ReadIntrinsicsFile(const std::string& path);

/// Returns the image size, pixels, whose centre fits the principal point: the first one, unless the
/// point is less than half as far from the centre of a later one, relative to the size. None if the
/// point is more than a tenth of the width or height off the centre of each.
std::optional<ImageSize> FindSizeOf(const PinholeCamera& camera,
                                    const std::vector<ImageSize>& sizes);

/// Returns the paths of the files of a folder named like calibration files, in
/// alphabetical order: "calibration.txt", "intrinsic.json", "camera_matrix.csv".
std::vector<std::string> FindCalibrationFiles(const std::string& folder);

}  // namespace msc_vo
