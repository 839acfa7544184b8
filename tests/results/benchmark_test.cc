// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark.h"

#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

BenchmarkRun GoodRun(const std::string& sequence, const std::string& mode, double ape) {
  BenchmarkRun run;
  run.sequence = sequence;
  run.mode = mode;
  run.summary.num_frames = 4;
  run.summary.status_counts = {3, 0, 0, 1, 0};
  run.cost.processor_seconds = 0.2;
  run.error.emplace();
  run.error->usable = true;
  run.error->ape.count = 4;
  run.error->ape.rmse = ape;
  return run;
}

BenchmarkRun FailedRun(const std::string& sequence, const std::string& mode) {
  BenchmarkRun run;
  run.sequence = sequence;
  run.mode = mode;
  run.failure = "unreadable | indeed\nsecond line";
  return run;
}

// The third sequence has failed in one mode, the fourth was interrupted after the first mode.
Benchmark FourSequences() {
  Benchmark benchmark;
  benchmark.build = "GNU 12, Release";
  benchmark.modes = {"old", "new"};
  benchmark.changed_options = {{"use_lines", "false"}};
  benchmark.runs = {GoodRun("a", "old", 0.004),   GoodRun("a", "new", 0.001),
                    GoodRun("b|c", "old", 0.001), GoodRun("b|c", "new", 0.001),
                    FailedRun("d", "old"),        GoodRun("d", "new", 0.5),
                    GoodRun("e", "old", 0.7)};
  return benchmark;
}

TEST(Benchmark, ComparesOnlySequencesThatEveryModeCompleted) {
  const MeanError mean = GeometricMean(FourSequences());
  EXPECT_EQ(mean.num_sequences, 2);
  ASSERT_EQ(mean.ape.size(), 2u);
  EXPECT_NEAR(mean.ape[0], 0.002, 1e-12);  // sqrt(4 * 1) mm
  EXPECT_NEAR(mean.ape[1], 0.001, 1e-12);
}

TEST(Benchmark, WithoutASequenceThereIsNoMean) {
  Benchmark benchmark;
  benchmark.modes = {"old"};
  EXPECT_EQ(GeometricMean(benchmark).num_sequences, 0);
  EXPECT_TRUE(std::isnan(GeometricMean(benchmark).ape[0]));
  EXPECT_THAT(FormatBenchmarkMarkdown(benchmark), Not(HasSubstr("geometric mean")));
  const nlohmann::json json = nlohmann::json::parse(FormatBenchmarkJson(benchmark));
  EXPECT_TRUE(json["geometric_mean"]["ape_rmse"]["old"].is_null());
}

TEST(Benchmark, WritesTables) {
  EXPECT_THAT(
      FormatBenchmarkMarkdown(FourSequences()),
      AllOf(HasSubstr("- build: GNU 12, Release\n"), HasSubstr("defaults: `use_lines=false`\n"),
            HasSubstr("| APE RMSE, mm        |    old |     new |\n"
                      "| ------------------- | -----: | ------: |\n"
                      "| a                   |   4.00 |    1.00 |\n"
                      "| b/c                 |   1.00 |    1.00 |\n"
                      "| d                   | failed |  500.00 |\n"
                      "| e                   | 700.00 | not run |\n"
                      "| geometric mean of 2 |   2.00 |    1.00 |\n"
                      "| ratio to old        |  1.000 |   0.500 |\n"
                      "\nNot in the mean, as a run failed: d.\n"),
            HasSubstr("## Mode new\n"), HasSubstr(" 75.0 | 1 lost |"), HasSubstr(" 50.0 |"),
            HasSubstr("- d, old: unreadable / indeed\n\n")));
}

TEST(Benchmark, LeavesOutWhatThereIsNothingToSayOf) {
  Benchmark benchmark;
  benchmark.modes = {"only"};
  benchmark.runs = {GoodRun("a", "only", 0.004)};
  EXPECT_THAT(FormatBenchmarkMarkdown(benchmark),
              AllOf(HasSubstr("geometric mean of 1"), Not(HasSubstr("ratio"))));
  benchmark.modes = {"only", "later"};
  EXPECT_THAT(
      FormatBenchmarkMarkdown(benchmark),
      AllOf(HasSubstr("not run"), HasSubstr("## Mode only"), Not(HasSubstr("## Mode later"))));
}

TEST(Benchmark, WritesTheSameAsJson) {
  const nlohmann::json json = nlohmann::json::parse(FormatBenchmarkJson(FourSequences()));
  EXPECT_EQ(json["changed_options"]["use_lines"], "false");
  EXPECT_EQ(json["runs"].size(), 7u);
  EXPECT_EQ(json["runs"][1]["error"]["ape_rmse"], 0.001);
  EXPECT_EQ(json["runs"][1]["frames"]["lost"], 1);
  EXPECT_EQ(json["runs"][4]["failure"], "unreadable | indeed\nsecond line");
  EXPECT_EQ(json["geometric_mean"]["sequences"], 2);
}

}  // namespace
}  // namespace msc_vo
