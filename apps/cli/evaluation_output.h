// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/evaluation/line_error.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/results/error_json.h"

namespace msc_vo {

/// The tables of `msc_vo evaluate` in millimetres and degrees.
std::string FormatErrorTable(const TrajectoryError& error, const EvaluationContext& context);
std::string FormatLineTable(const LineError& error);
/// A row for each segment; empty without segments.
std::string FormatSegmentTable(const std::vector<SegmentError>& segments, bool has_several_worlds);

/// Text at the beginning of the plots, see OutputKind.
inline constexpr char kComparisonMark[] = "<title>Evaluation of ";

/// Writes the plots of the two trajectories to a file: a page (.html) or an image (.svg). `name`:
/// of the estimate. Throws std::runtime_error, naming the file, if it cannot be written.
void WriteComparison(const std::string& path, const std::string& name, const TrajectoryError& error,
                     const EvaluationContext& context);

}  // namespace msc_vo
