// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark_merge.h"

#include "tests/results/benchmark_runs.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/results/benchmark_index.h"
#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

BenchmarkRun MakeRun(const std::string& sequence, int index, const std::string& mode, double ape) {
  BenchmarkRun run = GoodRun(sequence, mode, ape, 0.1 / 3.0);
  run.sequence_index = index;
  run.directory = "data/" + sequence;
  run.error->num_matched = 4;
  return run;
}

Benchmark MakeBenchmark(const std::vector<BenchmarkRun>& runs) {
  Benchmark benchmark;
  benchmark.command_line = "msc_vo benchmark";
  benchmark.build = "GNU";
  benchmark.num_processors = 2;
  benchmark.changed_options = {{"use_lines", "false"}};
  benchmark.modes = {"new", "old"};
  benchmark.runs = runs;
  return benchmark;
}

class BenchmarkMergeTest : public TemporaryFolder {};

TEST_F(BenchmarkMergeTest, ReadsWhatItWrites) {
  BenchmarkRun failed = MakeRun("b", 1, "old", 0.0);
  failed.failure = "lost";
  failed.error.reset();
  const Benchmark benchmark = MakeBenchmark({MakeRun("a", 0, "new", 0.1 / 7.0), failed});
  WriteText("benchmark.json", FormatBenchmarkJson(benchmark));
  const Benchmark read = ReadBenchmarkJson(Path("benchmark.json"));
  EXPECT_EQ(FormatBenchmarkJson(read), FormatBenchmarkJson(benchmark));
  EXPECT_EQ(FormatBenchmarkMarkdown(read), FormatBenchmarkMarkdown(benchmark));
  EXPECT_EQ(read.runs[0].folder, Path("a/new"));
  EXPECT_EQ(DescribeDifference(read, benchmark), "");
}

TEST_F(BenchmarkMergeTest, NamesTheFileThatItCannotRead) {
  WriteText("benchmark.json", "{\"version\": \"0.0.1\"}");
  EXPECT_THAT(MessageOf([&] { ReadBenchmarkJson(Path("benchmark.json")); }),
              Names("benchmark.json", "0.0.1"));
  WriteText("benchmark.json", "no JSON");
  EXPECT_THAT(MessageOf([&] { ReadBenchmarkJson(Path("benchmark.json")); }),
              Names("benchmark.json", "read"));
}

TEST_F(BenchmarkMergeTest, PrefersRunsThatSucceeded) {
  BenchmarkRun failed = MakeRun("a", 0, "new", 0.0);
  failed.failure = "cut off";
  Benchmark benchmark = MakeBenchmark({MakeRun("b", 1, "new", 2.0), failed});
  AddRuns({MakeRun("a", 0, "old", 3.0), MakeRun("a", 0, "new", 4.0), MakeRun("b", 1, "new", 5.0)},
          &benchmark);
  ASSERT_EQ(benchmark.runs.size(), 3u);
  EXPECT_EQ(benchmark.runs[0].error->ape.rmse, 4.0);  // a, new: by sequence, then by mode
  EXPECT_EQ(benchmark.runs[1].error->ape.rmse, 3.0);  // a, old
  EXPECT_EQ(benchmark.runs[2].error->ape.rmse, 2.0);  // b, new: the first one
}

TEST_F(BenchmarkMergeTest, FindsSharesAndMissingOnes) {
  EXPECT_EQ(ShardFileName("benchmark", {2, 4}, ".json"), "benchmark-2-of-4.json");
  EXPECT_EQ(ShardFileName("index", {}, ".html"), "index.html");
  for (const char* name : {"benchmark-1-of-3.json", "benchmark-3-of-3.json", "benchmark.json",
                           "benchmark.md", "benchmark-x-of-3.json"}) {
    WriteText(name, "");
  }
  const std::vector<std::string> files = FindBenchmarkFiles(Folder());
  EXPECT_THAT(files, ElementsAre(Path("benchmark-1-of-3.json"), Path("benchmark-3-of-3.json"),
                                 Path("benchmark.json")));
  EXPECT_THAT(MissingShards(files), ElementsAre("2 of 3"));
  EXPECT_THAT(MissingShards({Path("benchmark.json")}), IsEmpty());
}

TEST_F(BenchmarkMergeTest, DescribesDifferentSettings) {
  const Benchmark benchmark = MakeBenchmark({});
  Benchmark other = benchmark;
  other.changed_options = {};
  EXPECT_THAT(DescribeDifference(benchmark, other), Names("options", "use_lines=false"));
  other = benchmark;
  other.modes = {"new"};
  EXPECT_THAT(DescribeDifference(benchmark, other), Names("modes", "new", "old"));
  other = benchmark;
  other.max_frames = 10;
  EXPECT_THAT(DescribeDifference(benchmark, other), Names("--max-frames", "0", "10"));
  other = benchmark;
  other.mask = "mask";
  other.mask_zero = true;
  EXPECT_THAT(DescribeDifference(benchmark, other), Names("--mask", "none", "--mask-zero"));
}

TEST_F(BenchmarkMergeTest, LinksReports) {
  BenchmarkRun run = MakeRun("a b#", 0, "new", 0.0012);
  run.folder = Path("results/a b#/new");
  WriteText("results/a b#/new/report.html", "");
  BenchmarkRun failed = MakeRun("c", 1, "old", 0.0);
  failed.failure = "<lost>";
  MakeFolder(Path("tables"));
  const std::string html = FormatBenchmarkIndex(MakeBenchmark({run, failed}), Path("tables"));
  EXPECT_THAT(html, AllOf(HasSubstr("<a href=\"../results/a%20b%23/new/report.html\">1.20</a>"),
                          HasSubstr("title=\"&lt;lost&gt;\">failed</td>"), HasSubstr("not run"),
                          HasSubstr("use_lines=false"), Not(HasSubstr("<script"))));
}

}  // namespace
}  // namespace msc_vo
