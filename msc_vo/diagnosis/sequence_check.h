// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/diagnosis/finding.h"
#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

struct SequenceCheckOptions {
  /// Number of images to decode, evenly spread over the sequence; all files are tested for
  /// existence.
  int max_images = 30;
  /// Also runs the odometry to compare its motion with calibration, time stamps and ground truth;
  /// takes up to a minute.
  bool deep = false;
  OdometryOptions odometry;  ///< of that run, and of the features of the decoded images
};

/// Checks a sequence before a run: files, stamps and gaps, image sizes and bit depths, exposure and
/// blur, range and byte order of depth, registration of depth to colour, texture, and whether the
/// ground truth belongs to the images. Problems of the sequence are reported as findings, not
/// thrown. Throws std::invalid_argument on invalid options of the odometry.
Findings CheckSequence(const RgbdDecoder& decoder, const SequenceCheckOptions& options = {});

/// The part of CheckSequence() that takes less than 0.3 s: four images are decoded, and no file is
/// searched for. Contains warnings and errors only; an error means that no run can succeed.
Findings CheckSequenceQuickly(const RgbdDecoder& decoder);

/// Whether the depth edges of four images lie on the edges of colour, as those of registered depth
/// do. False if there are too few of them.
bool HasRegisteredEdges(const RgbdDecoder& decoder);

}  // namespace msc_vo
