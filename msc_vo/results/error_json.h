// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/evaluation/trajectory_error.h"

namespace msc_vo {

/// Rows of two trajectory files that were skipped because a number is not finite.
struct SkippedRows {
  int reference = 0;
  int estimate = 0;
};

/// The arguments of an evaluation that its output repeats.
struct EvaluationContext {
  std::string reference_format;  ///< "tum"
  std::string estimate_format;
  bool has_stamps = true;
  RelativeDelta delta;  ///< of TrajectoryError::rpe
};

/// "frames", "metres", "seconds".
const char* ToString(DeltaUnit unit);

/// The output of `msc_vo evaluate --json`: errors in metres, degrees and seconds. Errors of lines
/// are in the object "lines", which is absent without `lines`, those of segments in the list
/// "segments", which is absent without `segments`.
std::string FormatErrorJson(const TrajectoryError& error, const SkippedRows& skipped,
                            const EvaluationContext& context = {},
                            const std::optional<LineError>& lines = std::nullopt,
                            const std::vector<SegmentError>& segments = {});

}  // namespace msc_vo
