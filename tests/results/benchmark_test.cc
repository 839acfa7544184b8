// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark.h"

#include <cmath>

#include "tests/results/benchmark_runs.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/version.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

BenchmarkRun FailedRun(const std::string& sequence, const std::string& mode) {
  BenchmarkRun run;
  run.sequence = sequence;
  run.mode = mode;
  run.failure = "unreadable | indeed\nsecond line";
  return run;
}

// The third sequence failed in one mode; the fourth was interrupted after the first mode.
Benchmark FourSequences() {
  Benchmark benchmark;
  benchmark.command_line = "msc_vo benchmark a b";
  benchmark.num_processors = 8;
  benchmark.build = "GNU 12, Release";
  benchmark.modes = {"old", "new"};
  benchmark.changed_options = {{"use_lines", "false"}};
  benchmark.runs = {GoodRun("a", "old", 0.004),   GoodRun("a", "new", 0.001),
                    GoodRun("b|c", "old", 0.001), GoodRun("b|c", "new", 0.001),
                    FailedRun("d", "old"),        GoodRun("d", "new", 0.5),
                    GoodRun("e", "old", 0.7)};
  return benchmark;
}

TEST(Benchmark, AveragesSequencesThatEveryModeCompleted) {
  const MeanError mean = GeometricMean(FourSequences());
  EXPECT_EQ(mean.num_sequences, 2);
  ASSERT_EQ(mean.ape.size(), 2u);
  EXPECT_NEAR(mean.ape[0], 0.002, 1e-12);  // sqrt(4 * 1) mm
  EXPECT_NEAR(mean.ape[1], 0.001, 1e-12);
}

TEST(Benchmark, HasNoMeanWithoutSequences) {
  Benchmark benchmark;
  benchmark.modes = {"old"};
  EXPECT_EQ(GeometricMean(benchmark).num_sequences, 0);
  EXPECT_TRUE(std::isnan(GeometricMean(benchmark).ape[0]));
  EXPECT_THAT(FormatBenchmarkMarkdown(benchmark), Not(HasSubstr("geometric mean")));
  const nlohmann::json json = nlohmann::json::parse(FormatBenchmarkJson(benchmark));
  EXPECT_TRUE(json["geometric_mean"]["ape_rmse"]["old"].is_null());
}

// The whole file, except for the legend after the tables.
TEST(Benchmark, WritesTables) {
  const std::string expected = std::string("# msc_vo benchmark\n\n- version: msc_vo ") + kVersion +
                               R"(
- command: `msc_vo benchmark a b`
- build: GNU 12, Release
- processors: 8
- options other than the defaults: `use_lines=false`

## Position error after alignment

| APE RMSE, mm        |    old |     new |
| ------------------- | -----: | ------: |
| a                   |   4.00 |    1.00 |
| b/c                 |   1.00 |    1.00 |
| d                   | failed |  500.00 |
| e                   | 700.00 | not run |
| geometric mean of 2 |   2.00 |    1.00 |
| ratio to old        |  1.000 |   0.500 |

Excluded from the mean because a run failed: d.

## Mode old

| old  | APE, mm | RPE, mm/s | frames | tracked, % | others | tracking, ms | 95 %, ms | processor, ms | mapping, ms | keyframes | memory, MiB |
| ---- | ------: | --------: | -----: | ---------: | -----: | -----------: | -------: | ------------: | ----------: | --------: | ----------: |
| a    |    4.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |
| b/c  |    1.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |
| d    |  failed |         - |      - |          - |      - |            - |        - |             - |           - |         - |           - |
| e    |  700.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |

## Mode new

| new  | APE, mm | RPE, mm/s | frames | tracked, % | others | tracking, ms | 95 %, ms | processor, ms | mapping, ms | keyframes | memory, MiB |
| ---- | ------: | --------: | -----: | ---------: | -----: | -----------: | -------: | ------------: | ----------: | --------: | ----------: |
| a    |    1.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |
| b/c  |    1.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |
| d    |  500.00 |      2.00 |      4 |       75.0 | 1 lost |         12.5 |     20.0 |          50.0 |        30.0 |         2 |         123 |

## Failed runs

- d, old: unreadable / indeed

APE: )";
  const std::string text = FormatBenchmarkMarkdown(FourSequences());
  EXPECT_EQ(text.substr(0, expected.size()), expected);
}

TEST(Benchmark, OmitsEmptyTables) {
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

TEST(Benchmark, WritesTheNumbersOfTheTablesAsJson) {
  const nlohmann::json json = nlohmann::json::parse(FormatBenchmarkJson(FourSequences()));
  EXPECT_EQ(json["changed_options"]["use_lines"], "false");
  EXPECT_EQ(json["runs"].size(), 7u);
  EXPECT_EQ(json["runs"][1]["error"]["ape_rmse"], 0.001);
  EXPECT_EQ(json["runs"][1]["error"]["rpe_1s"], 0.002);
  EXPECT_TRUE(json["runs"][1]["error"]["rpe_1m"].is_null());  // no pairs
  EXPECT_EQ(json["runs"][1]["frames"]["lost"], 1);
  EXPECT_EQ(json["runs"][1]["stages_ms"]["tracking"]["p95"], 20.0);
  EXPECT_EQ(json["runs"][1]["processor_seconds"], 0.2);
  EXPECT_TRUE(json["runs"][1]["failure"].is_null());
  EXPECT_TRUE(json["runs"][4]["error"].is_null());
  EXPECT_EQ(json["runs"][4]["failure"], "unreadable | indeed\nsecond line");
  EXPECT_EQ(json["geometric_mean"]["sequences"], 2);
  EXPECT_NEAR(json["geometric_mean"]["ape_rmse"]["old"], 0.002, 1e-12);
}

}  // namespace
}  // namespace msc_vo
