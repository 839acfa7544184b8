// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// One folder layout. Each lives in its own file; OpenSequence asks them in turn.
struct SequenceFormat {
  const char* name;         // for --format
  const char* description;  // what the folder holds, for messages
  bool (*recognises)(const std::string& directory);
  // Fills everything but `format` and `directory`; order and uniqueness of the stamps are
  // OpenSequence's business.
  SequenceIndex (*read)(const std::string& directory);
};

extern const SequenceFormat kSevenScenesFormat;
extern const SequenceFormat kReplicaFormat;
extern const SequenceFormat kScanNetFormat;
extern const SequenceFormat kIclNuimFormat;
extern const SequenceFormat kTumFormat;
extern const SequenceFormat kRgbDepthFormat;

// Images without stamps of their own are taken at the rate of the sensors these layouts come from.
constexpr double kDefaultFrameRate = 30.0;  // 1/seconds

}  // namespace msc_vo
