// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/sensor/depth_sensor.h"

namespace msc_vo {

struct SequenceCheckOptions {
  /// Number of images to decode, evenly spread over the sequence; all files are tested for
  /// existence.
  int max_images = 30;
  /// Also tracks features over frames to compare motion with calibration, time stamps and ground
  /// truth; takes up to a minute.
  bool deep = false;
  DepthSensor depth_sensor = DepthSensor::kAuto;  ///< that measured depth
};

/// Checks a sequence before a run: files, stamps and gaps, image sizes and bit depths, exposure and
/// blur, range and byte order of depth, registration of depth to colour, texture, and whether the
/// ground truth belongs to the images. Problems of the sequence are reported as findings, not
/// thrown.
Findings CheckSequence(const RgbdDecoder& decoder, const SequenceCheckOptions& options = {});

/// The part of CheckSequence() that takes less than 0.3 s: four images are decoded, and no file is
/// searched for. Contains warnings and errors only; an error means that no run can succeed.
Findings CheckSequenceQuickly(const RgbdDecoder& decoder);

}  // namespace msc_vo
