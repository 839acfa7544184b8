// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/report_statistics.h"

#include <limits>

#include "fake_run.h"
#include <gtest/gtest.h>

namespace msc_vo {
namespace {

TEST(SummarizeStage, MatchesHandComputedValues) {
  const StageTimeStatistics stage = SummarizeStage("lines", {4.0, 1.0, 3.0, 2.0, 10.0});
  EXPECT_EQ(stage.name, "lines");
  EXPECT_EQ(stage.count, 5);
  EXPECT_DOUBLE_EQ(stage.mean, 4.0);
  EXPECT_DOUBLE_EQ(stage.median, 3.0);
  EXPECT_DOUBLE_EQ(stage.p95, 10.0);  // four of five are only 80 %
  EXPECT_DOUBLE_EQ(stage.max, 10.0);
}

TEST(SummarizeStage, ComputesQuantiles) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  EXPECT_DOUBLE_EQ(SummarizeStage("x", values).p95, 95.0);
  EXPECT_DOUBLE_EQ(SummarizeStage("x", values).median, 50.0);
}

TEST(SummarizeStage, SkipsNonFiniteValues) {
  EXPECT_EQ(SummarizeStage("x", {std::numeric_limits<double>::quiet_NaN(), 2.0}).count, 1);
  EXPECT_EQ(SummarizeStage("x", {}).max, 0.0);
}

TEST(SummarizeStages, CountsMappingOverKeyframeStepsOnly) {
  const ReportData data = MakeFakeRun(120);
  const auto stages = SummarizeStages(data.stages, data.frames);
  ASSERT_EQ(stages.size(), data.stages.size() + 2);
  EXPECT_EQ(stages.front().name, "points");
  EXPECT_EQ(stages.front().count, 120);
  EXPECT_EQ(stages.back().name, "mapping");
  EXPECT_EQ(stages.back().count, 10);
  EXPECT_GE(stages.back().median, 40.0);
}

TEST(FindNotTrackedSpans, GroupsConsecutiveFrames) {
  std::vector<ReportFrame> frames(8);
  for (int i = 0; i < 8; ++i) frames[i].timestamp = 10.0 + i;
  frames[1].status = ReportStatus::kWeak;
  frames[2].status = ReportStatus::kPredicted;
  frames[3].status = ReportStatus::kLost;
  frames[7].status = ReportStatus::kLost;
  const auto spans = FindNotTrackedSpans(frames);
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_EQ(spans[0].first_frame, 2);
  EXPECT_EQ(spans[0].last_frame, 3);
  EXPECT_EQ(spans[0].num_lost, 1);
  EXPECT_EQ(spans[0].start, 12.0);
  EXPECT_EQ(spans[0].end, 13.0);
  EXPECT_EQ(spans[1].first_frame, 7);
  EXPECT_EQ(spans[1].last_frame, 7);
}

TEST(FindSubMaps, AreInOrderOfTheirFirstFrames) {
  std::vector<ReportFrame> frames(6);
  EXPECT_EQ(FindSubMaps(frames).size(), 1u);
  const int numbers[] = {kNoSubMapNumber, 3, 3, 1, 3, kNoSubMapNumber};
  for (int i = 0; i < 6; ++i) frames[i].submap = numbers[i];
  const std::vector<SubMapStart> submaps = FindSubMaps(frames);
  ASSERT_EQ(submaps.size(), 2u);
  EXPECT_EQ(submaps[0].number, 3);
  EXPECT_EQ(submaps[0].first_frame, 1);
  EXPECT_EQ(submaps[1].number, 1);
  EXPECT_EQ(submaps[1].first_frame, 3);
}

}  // namespace
}  // namespace msc_vo
