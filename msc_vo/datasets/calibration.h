// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>

#include "msc_vo/camera/lens_distortion.h"

namespace msc_vo {

/// Calibration of an RGB-D camera: intrinsics, lens distortion, depth scale and readout time.
struct Calibration {
  static constexpr char kSelfCalibrated[] = "self-calibrated from the images";

  PinholeCamera camera;
  LensDistortion distortion;
  double depth_scale = 5000.0;  ///< raw depth units per metre
  /// Readout time of a rolling shutter: seconds from the first image row to the last, negative if
  /// the last row comes first; 0: global shutter. None: unknown, to be self-calibrated.
  std::optional<double> readout_time;
  std::string readout_origin = kSelfCalibrated;  ///< source of the readout time, for messages
  std::string origin;  ///< source of the other values, for messages: "camera.txt"

  /// If the calibration is invalid, `error` names the value and its valid range.
  bool IsValid(std::string* error) const;
};

/// The camera section of a configuration. Values that are not set come from other sources, see
/// ResolveCalibration().
struct CameraSettings {
  std::string preset;  ///< name of a CameraPreset; may be empty
  std::optional<double> fx, fy, cx, cy;
  std::optional<int> width, height;
  std::optional<double> depth_scale;                ///< raw depth units per metre
  std::array<std::optional<double>, 5> distortion;  ///< k1 k2 p1 p2 k3
  std::string origin;                               ///< the file, for messages

  /// Tests whether no value is set.
  bool IsEmpty() const;
};

}  // namespace msc_vo
