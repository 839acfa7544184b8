// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// Milliseconds of one stage over the frames in which it ran.
struct StageTimeStatistics {
  std::string name;
  int count = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double max = 0.0;
};

/// Median and 95 % quantile are values that occurred, as many frames took no longer; values that
/// are not finite do not count. All zero if nothing is left.
StageTimeStatistics SummarizeStage(const std::string& name, std::vector<double> milliseconds);

/// The stages of tracking that ReportFrame::stage_ms holds, "tracking" as a whole over all frames,
/// and "mapping" over the frames that caused a keyframe step.
std::vector<StageTimeStatistics> SummarizeStages(const std::vector<ReportStage>& stages,
                                                 const std::vector<ReportFrame>& frames);

/// Successive frames without an estimated pose (predicted or lost).
struct NotTrackedSpan {
  int first_frame = 0;  ///< index into ReportData::frames
  int last_frame = 0;   ///< inclusive
  int num_lost = 0;     ///< the others were predicted
  double start = 0.0;   ///< seconds, stamps of the two
  double end = 0.0;
};
std::vector<NotTrackedSpan> FindNotTrackedSpans(const std::vector<ReportFrame>& frames);

}  // namespace msc_vo
