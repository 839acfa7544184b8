// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

// All that must be known of a camera to turn its files into metres.
struct Calibration {
  static constexpr char kReadoutLearnt[] = "learnt from the images";

  PinholeCamera camera;
  LensDistortion distortion;
  double depth_scale = 5000.0;  // raw depth units per metre
  // Readout time of a rolling shutter: seconds from the first row of an image to its last, negative
  // if the last comes first; 0: global shutter. None: unknown, to be learnt from the images.
  std::optional<double> readout_time;
  std::string readout_origin = kReadoutLearnt;  // where the readout time comes from
  std::string origin;  // where the other numbers come from, for messages: "camera.txt"

  bool IsValid(std::string* error) const;
};

// Reads camera.txt: one line 'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]', distortion in
// OpenCV's order, and optionally a second line 'readout_time SECONDS'; # starts a comment. Throws
// std::runtime_error naming file, line and fix.
Calibration ReadCameraFile(const std::string& path);

// What a configuration says about the camera; what it leaves out comes from elsewhere.
struct CameraSettings {
  std::string preset;  // name of a built-in camera; may be empty
  std::optional<double> fx, fy, cx, cy;
  std::optional<int> width, height;
  std::optional<double> depth_scale;                // raw depth units per metre
  std::array<std::optional<double>, 5> distortion;  // k1 k2 p1 p2 k3
  std::string origin;                               // the file, for messages

  bool IsEmpty() const;
};

struct SequenceIndex;

// The calibration of a sequence. In order of precedence: the values of `settings`, a file of the
// folder, the preset named by `settings` or `preset`, the preset that the folder suggests. A
// missing image size is taken from the first depth image. A preset that the folder only suggests
// gives no readout time: a name is no evidence of how the camera works, the images are. Warnings
// for the user go to `index->warnings`. Throws std::runtime_error, listing what can be done, if
// that does not make a whole calibration; std::invalid_argument on an unknown preset.
Calibration ResolveCalibration(const CameraSettings& settings, const std::string& preset,
                               SequenceIndex* index);

}  // namespace msc_vo
