// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// A folder layout of RGB-D sequences. Each layout is implemented in a file of its own.
struct SequenceFormat {
  const char* name;         ///< for --format
  const char* description;  ///< expected files, for messages
  const char* recorder;     ///< what records or publishes sequences in this layout, for messages
  std::function<bool(const std::string& directory)> recognises;
  /// Fills all fields except `format`, `recorder` and `directory`. OpenSequence() sorts the entries
  /// and removes repeated stamps.
  std::function<SequenceIndex(const std::string& directory)> read;
};

extern const SequenceFormat kSevenScenesFormat;
extern const SequenceFormat kReplicaFormat;
extern const SequenceFormat kScanNetFormat;
extern const SequenceFormat kIclNuimFormat;
extern const SequenceFormat kTumFormat;
extern const SequenceFormat kRgbDepthFormat;

/// Frame rate of images without stamps: that of the sensors that these layouts were recorded with.
constexpr double kDefaultFrameRate = 30.0;  // 1/seconds

}  // namespace msc_vo
