// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "msc_vo/geometry/erase_if.h"

namespace msc_vo {
namespace {

// The smallest value that at least the fraction q of all values do not exceed. `sorted` must not
// be empty.
double Quantile(const std::vector<double>& sorted, double q) {
  const double rank = std::ceil(q * static_cast<double>(sorted.size()));
  return sorted[static_cast<size_t>(std::max(rank, 1.0)) - 1];
}

}  // namespace

StageTimeStatistics SummarizeStage(const std::string& name, std::vector<double> milliseconds) {
  EraseIf(&milliseconds, [](double ms) { return !std::isfinite(ms); });
  StageTimeStatistics statistics;
  statistics.name = name;
  if (milliseconds.empty()) return statistics;
  std::sort(milliseconds.begin(), milliseconds.end());
  statistics.count = static_cast<int>(milliseconds.size());
  statistics.mean =
      std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0) / statistics.count;
  statistics.median = Quantile(milliseconds, 0.5);
  statistics.p95 = Quantile(milliseconds, 0.95);
  statistics.max = milliseconds.back();
  return statistics;
}

std::vector<StageTimeStatistics> SummarizeStages(const std::vector<ReportStage>& stages,
                                                 const std::vector<ReportFrame>& frames) {
  const auto summarize = [&frames](const std::string& name, const auto& milliseconds_of) {
    std::vector<double> values;
    for (const ReportFrame& frame : frames) values.push_back(milliseconds_of(frame));
    return SummarizeStage(name, std::move(values));
  };
  std::vector<StageTimeStatistics> all;
  for (size_t i = 0; i < stages.size(); ++i) {
    all.push_back(
        summarize(stages[i].name, [i](const ReportFrame& frame) { return frame.stage_ms[i]; }));
  }
  all.push_back(summarize("tracking", [](const ReportFrame& frame) { return frame.tracking_ms; }));
  std::vector<double> mapping;
  for (const ReportFrame& frame : frames) {
    if (frame.mapping_ms > 0.0) mapping.push_back(frame.mapping_ms);
  }
  all.push_back(SummarizeStage("mapping", std::move(mapping)));
  return all;
}

std::vector<NotTrackedSpan> FindNotTrackedSpans(const std::vector<ReportFrame>& frames) {
  std::vector<NotTrackedSpan> spans;
  for (int i = 0; i < static_cast<int>(frames.size()); ++i) {
    const ReportStatus status = frames[i].status;
    const double time = frames[i].timestamp;
    if (status != ReportStatus::kPredicted && status != ReportStatus::kLost) continue;
    if (spans.empty() || spans.back().last_frame != i - 1) spans.push_back({i, i, 0, time, time});
    spans.back().last_frame = i;
    spans.back().end = time;
    if (status == ReportStatus::kLost) ++spans.back().num_lost;
  }
  return spans;
}

std::vector<SubMapStart> FindSubMaps(const std::vector<ReportFrame>& frames) {
  std::vector<SubMapStart> submaps;
  for (size_t i = 0; i < frames.size(); ++i) {
    const int number = frames[i].submap;
    const auto is_same = [number](const SubMapStart& submap) { return submap.number == number; };
    if (number == kNoSubMapNumber || std::any_of(submaps.begin(), submaps.end(), is_same)) continue;
    submaps.push_back({number, static_cast<int>(i)});
  }
  return submaps;
}

}  // namespace msc_vo
