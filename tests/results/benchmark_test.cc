// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark.h"

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "tests/results/benchmark_runs.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {
namespace {

using testing::_;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
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

// The cells of the rows of all tables, without the rulers below their headings.
std::vector<std::vector<std::string>> RowsOf(const std::string& markdown) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0 || line.rfind("| -", 0) == 0) continue;
    rows.emplace_back();
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) rows.back().push_back(Trimmed(cell));
  }
  return rows;
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
  EXPECT_EQ(RowsOf(FormatBenchmarkMarkdown(benchmark)).size(), 1u);  // the names of the modes
  const nlohmann::json json = nlohmann::json::parse(FormatBenchmarkJson(benchmark));
  EXPECT_TRUE(json["geometric_mean"]["ape_rmse"]["old"].is_null());
}

TEST(Benchmark, WritesTables) {
  const Benchmark benchmark = FourSequences();
  const std::string text = FormatBenchmarkMarkdown(benchmark);
  EXPECT_THAT(text,
              Names(kVersion, benchmark.command_line, benchmark.build, "8", "use_lines=false"));
  const auto rows = RowsOf(text);
  ASSERT_EQ(rows.size(), 7u + 5u + 4u);
  EXPECT_THAT(rows[0], ElementsAre(_, "old", "new"));
  EXPECT_THAT(rows[1], ElementsAre("a", "4.00", "1.00"));
  EXPECT_THAT(rows[2], ElementsAre("b/c", "1.00", "1.00"));
  EXPECT_THAT(rows[3], ElementsAre("d", "failed", "500.00"));
  EXPECT_THAT(rows[4], ElementsAre("e", "700.00", Not(Names("failed"))));
  EXPECT_THAT(rows[5], ElementsAre(Names("mean", "2"), "2.00", "1.00"));
  EXPECT_THAT(rows[6], ElementsAre(Names("old"), "1.000", "0.500"));
  EXPECT_EQ(rows[7].front(), "old");
  EXPECT_THAT(rows[8], ElementsAre("a", "4.00", "2.00", "4", "75.0", "1 lost", "12.5", "20.0",
                                   "50.0", "30.0", "2", "123"));
  EXPECT_THAT(rows[10],
              ElementsAre("d", "failed", "-", "-", "-", "-", "-", "-", "-", "-", "-", "-"));
  EXPECT_EQ(rows[12].front(), "new");
  EXPECT_THAT(rows[15], AllOf(Contains("d"), Contains("500.00")));
  EXPECT_THAT(LineNaming("Excluded", text), Names("d"));
  EXPECT_THAT(LineNaming("- d, old", text), Names("unreadable / indeed"));
}

// Readable without a renderer of Markdown.
TEST(Benchmark, AlignsTheColumnsOfATable) {
  std::istringstream lines(FormatBenchmarkMarkdown(FourSequences()));
  std::string before;
  for (std::string line; std::getline(lines, line); before = line) {
    if (line.empty() || before.empty() || line[0] != '|') continue;
    EXPECT_EQ(line.size(), before.size()) << line;
  }
}

TEST(Benchmark, OmitsEmptyTables) {
  Benchmark benchmark;
  benchmark.modes = {"only"};
  benchmark.runs = {GoodRun("a", "only", 0.004)};
  auto rows = RowsOf(FormatBenchmarkMarkdown(benchmark));
  ASSERT_EQ(rows.size(), 3u + 2u);  // no ratio to the only mode
  EXPECT_THAT(rows[2], ElementsAre(Names("mean", "1"), "4.00"));
  EXPECT_EQ(rows[3].front(), "only");
  benchmark.modes = {"only", "later"};
  rows = RowsOf(FormatBenchmarkMarkdown(benchmark));
  ASSERT_EQ(rows.size(), 2u + 2u);  // no mean, no table of the second mode
  EXPECT_THAT(rows[1], ElementsAre("a", "4.00", Not(Names("failed"))));
  EXPECT_EQ(rows[2].front(), "only");
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
