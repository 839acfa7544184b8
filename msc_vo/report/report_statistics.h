// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/report/report.h"

namespace msc_vo {

/// Milliseconds of one stage, over the frames in which it ran.
struct StageTimeStatistics {
  std::string name;
  int count = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;  ///< 95 % quantile
  double max = 0.0;
};

/// Median and 95 % quantile are measured values: the smallest that at least 50 % or 95 % of the
/// values do not exceed. Values that are not finite are skipped; without values all is zero.
StageTimeStatistics SummarizeStage(const std::string& name, std::vector<double> milliseconds);

/// Statistics of the stages in ReportFrame::stage_ms, of "tracking" as a whole over all frames, and
/// of "mapping" over the frames that caused a keyframe step.
std::vector<StageTimeStatistics> SummarizeStages(const std::vector<ReportStage>& stages,
                                                 const std::vector<ReportFrame>& frames);

/// Consecutive frames without an estimated pose (predicted or lost).
struct NotTrackedSpan {
  int first_frame = 0;  ///< index into ReportData::frames
  int last_frame = 0;   ///< inclusive
  int num_lost = 0;     ///< the others are predicted
  double start = 0.0;   ///< seconds, time stamp of the first frame
  double end = 0.0;     ///< seconds, time stamp of the last frame
};
std::vector<NotTrackedSpan> FindNotTrackedSpans(const std::vector<ReportFrame>& frames);

/// A submap that poses refer to.
struct SubMapStart {
  int number = 0;       ///< ReportFrame::submap
  int first_frame = 0;  ///< index of the first frame with a pose in it
};

/// The submaps that poses refer to, in order of their first frames.
std::vector<SubMapStart> FindSubMaps(const std::vector<ReportFrame>& frames);

}  // namespace msc_vo
