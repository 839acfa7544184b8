// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

enum class Severity {
  kGood,     // as it should be
  kWarning,  // legal, but a usual sign of a mistake
  kError,    // replay would fail, or go on without the image
};

// One thing that was looked at, in a sentence for the user.
struct Finding {
  Severity severity = Severity::kGood;
  std::string text;
};

struct SequenceCheckOptions {
  int max_images = 30;  // decoded, evenly spread over the sequence; files are looked for all
};

// Examines a sequence before a run: files, stamps and gaps, sizes and bit depths, depth in metres,
// the sign of fy, and whether the ground truth belongs to the images. Never throws because of what
// it finds.
std::vector<Finding> CheckSequence(const RgbdDecoder& decoder,
                                   const SequenceCheckOptions& options = {});

}  // namespace msc_vo
