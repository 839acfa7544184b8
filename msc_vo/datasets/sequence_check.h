// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

enum class Severity {
  kGood,     ///< no problem
  kWarning,  ///< valid, but a frequent sign of a mistake
  kError,    ///< replay would fail or skip the image
};

/// Result of one check, in a sentence for the user.
struct Finding {
  Severity severity = Severity::kGood;
  std::string text;
};

struct SequenceCheckOptions {
  /// Number of images to decode, evenly spread over the sequence; all files are tested for
  /// existence.
  int max_images = 30;
};

/// Checks a sequence before a run: files, stamps and gaps, image sizes and bit depths, range of
/// depth, sign of fy, and whether the stamps of the ground truth match those of the images.
/// Problems of the sequence are reported as findings, not thrown.
std::vector<Finding> CheckSequence(const RgbdDecoder& decoder,
                                   const SequenceCheckOptions& options = {});

}  // namespace msc_vo
