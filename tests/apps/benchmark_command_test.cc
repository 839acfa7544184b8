// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Benchmarks over tiny rendered sequences.

#include <cmath>
#include <csignal>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class BenchmarkCommandTest : public TemporaryFolder {
 protected:
  void Synthesize(const std::string& scene, int num_frames, const std::string& name) {
    RenderSequence(Path(name),
                   {"--scene", scene, "--frames", std::to_string(num_frames), "--width", "160"});
  }
  std::string Table() { return ReadFile(Path("out/benchmark.md")); }
  nlohmann::json Numbers() { return nlohmann::json::parse(ReadFile(Path("out/benchmark.json"))); }
};

TEST_F(BenchmarkCommandTest, ComparesModesOnSequences) {
  Synthesize("room", 12, "a/room");
  Synthesize("corridor", 12, "corridor");
  const CommandOutcome outcome = RunCommand(
      {"benchmark", Path("a/room") + "/", Path("corridor"), "--modes", "pl-vo,pl-vo-depth,pl-vo",
       "--output", Path("out"), "--set", "use_points=true", "--set", "tracking.wide_radius=55"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(Table()));
  EXPECT_THAT(Table(),
              AllOf(Names("version"), Names("processors"), Names("tracking.wide_radius=55"),
                    HasSubstr("\n| room "), HasSubstr("\n| corridor "), Names("geometric mean"),
                    Names("ratio"), HasSubstr("Mode pl-vo\n"), HasSubstr("Mode pl-vo-depth\n"),
                    Not(HasSubstr("failed"))));

  const nlohmann::json numbers = Numbers();
  EXPECT_THAT(numbers["modes"], ElementsAre("pl-vo", "pl-vo-depth"));
  ASSERT_EQ(numbers["runs"].size(), 4u);
  double log_sum = 0.0;
  for (const nlohmann::json& run : numbers["runs"]) {
    EXPECT_TRUE(run["failure"].is_null());
    EXPECT_EQ(run["frames"]["count"], 12);
    EXPECT_GT(run["processor_seconds"], 0.0);
    EXPECT_GT(run["peak_memory_mib"], 1.0);
    EXPECT_GT(run["stages_ms"]["tracking"]["p95"], 0.0);
    if (run["mode"] == "pl-vo") log_sum += std::log(run["error"]["ape_rmse"].get<double>());
    const std::string folder =
        "out/" + run["sequence"].get<std::string>() + "/" + run["mode"].get<std::string>() + "/";
    const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path(folder + "summary.json")));
    EXPECT_EQ(summary["error"], run["error"]);
    EXPECT_EQ(summary["options"]["mode"], run["mode"]);
    EXPECT_TRUE(std::filesystem::exists(Path(folder + "report.html")));
  }
  EXPECT_EQ(numbers["geometric_mean"]["sequences"], 2);
  EXPECT_NEAR(numbers["geometric_mean"]["ape_rmse"]["pl-vo"], std::exp(log_sum / 2.0), 1e-12);
}

TEST_F(BenchmarkCommandTest, ContinuesAfterFailedSequences) {
  Synthesize("room", 8, "room");
  Synthesize("room", 4, "b/room");
  std::filesystem::remove(Path("b/room/groundtruth.txt"));
  const CommandOutcome outcome =
      RunCommand({"benchmark", Path("nowhere"), Path("b/room"), Path("room"), "--modes",
                  "pl-vo-depth", "--max-frames", "6", "--output", Path("out"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "2", "3", "benchmark.md"));
  EXPECT_THAT(Table(), AllOf(LineNames("nowhere, pl-vo-depth:", "exist"),
                             LineNames("room, pl-vo-depth:", "ground truth")));
  EXPECT_EQ(Numbers()["geometric_mean"]["sequences"], 1);
  const nlohmann::json runs = Numbers()["runs"];
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_THAT(runs[0]["failure"].get<std::string>(), Names(Path("nowhere")));
  EXPECT_TRUE(runs[1]["error"].is_null());
  EXPECT_EQ(runs[2]["sequence"], "room-2");  // unique folder
  EXPECT_EQ(runs[2]["frames"]["count"], 6);
  EXPECT_TRUE(runs[2]["failure"].is_null());
}

TEST_F(BenchmarkCommandTest, TakesTheMasksOfEachSequence) {
  Synthesize("room", 8, "a");
  Synthesize("room", 12, "b");
  cv::Mat mask = cv::Mat::zeros(120, 160, CV_8UC1);
  mask.colRange(0, 40) = 255;
  ASSERT_TRUE(cv::imwrite(Path("a/arm.png"), mask));
  const auto benchmark = [this](const std::string& path, int exit_code) {
    const CommandOutcome outcome =
        RunCommand({"benchmark", Path("a"), Path("b"), "--modes", "pl-vo-depth", "--mask", path,
                    "--output", Path("out"), "--quiet"});
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    return outcome.output;
  };
  EXPECT_THAT(benchmark("arm.png", 1), Names(Path("b/arm.png"), "does not exist", "--mask"));
  EXPECT_TRUE(Numbers()["runs"][0]["failure"].is_null());
  ASSERT_TRUE(cv::imwrite(Path("b/arm.png"), mask));
  benchmark("arm.png", 0);
  EXPECT_EQ(Numbers()["mask"], "arm.png");
  const std::string of_b = ReadFile(Path("out/b/pl-vo-depth/trajectory.txt"));
  benchmark(Path("a/arm.png"), 0);  // one for all of them
  EXPECT_EQ(ReadFile(Path("out/b/pl-vo-depth/trajectory.txt")), of_b);
  EXPECT_THAT(RunCommand({"benchmark", Path("a"), Path("b"), "--modes", "pl-vo-depth", "--resume",
                          "--output", Path("out")})
                  .output,
              Names("--mask", "none", "settings"));
}

TEST_F(BenchmarkCommandTest, ExcludesRunsWithFailedTrackingFromTheMean) {
  Synthesize("room", 8, "good");
  Synthesize("room", 8, "black");
  for (const TextLine& image : ReadTextLines(Path("black/rgb.txt"))) {
    WriteImage("black/" + image.fields.at(1), CV_8UC3, 0, 160, 120);
  }
  const CommandOutcome outcome = RunCommand({"benchmark", Path("good"), Path("black"), "--modes",
                                             "pl-vo-depth", "--output", Path("out"), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("black, pl-vo-depth", "0", "8"));
  EXPECT_THAT(Table(), AllOf(Names("failed"), LineNames("black, pl-vo-depth:", "0", "8")));
  EXPECT_THAT(LineNaming("Excluded", Table()), Names("black"));
  const nlohmann::json numbers = Numbers();
  EXPECT_EQ(numbers["geometric_mean"]["sequences"], 1);
  EXPECT_NEAR(numbers["geometric_mean"]["ape_rmse"]["pl-vo-depth"],
              numbers["runs"][0]["error"]["ape_rmse"].get<double>(), 1e-12);
}

TEST_F(BenchmarkCommandTest, RunsAllModesByDefaultAndRejectsInvalidOptions) {
  Synthesize("room", 4, "room");
  EXPECT_EQ(RunCommand({"benchmark", Path("room"), "--output", Path("out")}).exit_code, 0);
  EXPECT_THAT(Numbers()["modes"], ElementsAre("pl-vo", "pl-vo-depth", "msc-vo"));
  const CommandOutcome wrong = RunCommand({"benchmark", Path("room"), "--output", Path("no"),
                                           "--set", "use_points=0x", "--modes", "pl-vo"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.output, LineNames("error:", "--set", "use_points", "'0x'"));
  const CommandOutcome blind =
      RunCommand({"benchmark", Path("room"), "--output", Path("no"), "--set", "use_points=false",
                  "--set", "use_lines=false"});
  EXPECT_EQ(blind.exit_code, 1);
  EXPECT_THAT(blind.output, LineNames("error:", "use_points", "use_lines"));
  EXPECT_FALSE(std::filesystem::exists(Path("no")));
}

TEST_F(BenchmarkCommandTest, WritesFinishedRunsOnInterrupt) {
  Synthesize("room", 40, "room");
  CommandProcess benchmark(
      {"benchmark", Path("room"), Path("room"), "--modes", "pl-vo-depth", "--output", Path("out")});
  // The heading of the second run follows the end of the first.
  ASSERT_TRUE(benchmark.WaitForOutput("room-2, pl-vo-depth:")) << benchmark.output();
  benchmark.Signal(SIGINT);
  EXPECT_EQ(benchmark.Wait(), 130) << benchmark.output();
  EXPECT_THAT(benchmark.output(), testing::HasSubstr("interrupted; finished runs are in "));
  const nlohmann::json runs = Numbers()["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_TRUE(runs[0]["failure"].is_null());
  EXPECT_EQ(runs[1]["failure"], "interrupted");
  EXPECT_THAT(Table(), LineNames("room-2, pl-vo-depth", "interrupted"));
}

class BenchmarkSharesTest : public BenchmarkCommandTest {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    for (const char* name : {"a", "b", "c"}) Synthesize("room", 6, name);
    // Saved on Windows.
    WriteText("list.txt",
              "\xEF\xBB\xBF"
              "a\r\n\r\n# two more\r\nb\r\nc\r\n");
  }
  CommandOutcome Benchmark(const std::string& output, std::vector<std::string> more) {
    std::vector<std::string> arguments = {"benchmark", Path("list.txt"), "--modes",   "pl-vo",
                                          "--quiet",   "--output",       Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  CommandOutcome Merge(std::vector<std::string> folders) {
    folders.insert(folders.begin(), {"benchmark", "--output", Path("merged"), "--merge"});
    return RunCommand(folders);
  }
  // The runs without what depends on the machine.
  nlohmann::json Runs(const std::string& folder, const std::string& name = "benchmark.json") {
    nlohmann::json runs = nlohmann::json::parse(ReadFile(Path(folder + "/" + name)))["runs"];
    for (nlohmann::json& run : runs) {
      for (const char* key : {"stages_ms", "wall_seconds", "frames_per_second", "processor_seconds",
                              "peak_memory_mib"}) {
        run.erase(key);
      }
    }
    return runs;
  }
};

TEST_F(BenchmarkSharesTest, MergesToTheResultsOfOneProgram) {
  ASSERT_EQ(Benchmark("whole", {}).exit_code, 0);
  EXPECT_THAT(ReadFile(Path("whole/index.html")), HasSubstr("href=\"b/pl-vo/report.html\""));
  ASSERT_EQ(Benchmark("shares", {"--shard", "1/2"}).exit_code, 0);
  EXPECT_EQ(Runs("shares", "benchmark-1-of-2.json").size(), 2u);  // a and c

  const CommandOutcome half = Merge({Path("shares")});
  EXPECT_EQ(half.exit_code, 1);
  EXPECT_THAT(half.output, Names("error:", "shard 2"));
  ASSERT_EQ(Benchmark("elsewhere", {"--shard", "2/2"}).exit_code, 0);
  const CommandOutcome merged = Merge({Path("shares"), Path("elsewhere")});
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  EXPECT_EQ(Runs("merged"), Runs("whole"));
  EXPECT_THAT(ReadFile(Path("merged/index.html")),
              AllOf(HasSubstr("href=\"../shares/a/pl-vo/report.html\""),
                    HasSubstr("href=\"../elsewhere/b/pl-vo/report.html\"")));
}

TEST_F(BenchmarkSharesTest, ResumesAfterAKilledRun) {
  Synthesize("room", 300, "b");  // long enough to be killed in it
  CommandProcess benchmark(
      {"benchmark", Path("list.txt"), "--modes", "pl-vo", "--output", Path("out")});
  ASSERT_TRUE(benchmark.WaitForOutput("b, pl-vo:")) << benchmark.output();
  benchmark.Signal(SIGKILL);
  EXPECT_EQ(benchmark.Wait(), -SIGKILL);
  nlohmann::json runs = Runs("out");
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_TRUE(runs[1]["failure"].is_string());

  const CommandOutcome rest = RunCommand(
      {"benchmark", Path("list.txt"), "--modes", "pl-vo", "--output", Path("out"), "--resume"});
  EXPECT_EQ(rest.exit_code, 0) << rest.output;
  EXPECT_THAT(rest.output, Not(HasSubstr("a, pl-vo:\n")));
  // The run that was cut off comes last.
  EXPECT_LT(rest.output.find("c, pl-vo:\n"), rest.output.find("b, pl-vo:\n"));
  runs = Runs("out");
  ASSERT_EQ(runs.size(), 3u);
  for (const nlohmann::json& run : runs) EXPECT_TRUE(run["failure"].is_null());
  EXPECT_EQ(runs[1]["sequence"], "b");
}

TEST_F(BenchmarkSharesTest, RefusesOtherSettingsAndWrongArguments) {
  ASSERT_EQ(Benchmark("out", {"--max-frames", "4"}).exit_code, 0);
  const CommandOutcome resumed = Benchmark("out", {"--resume"});
  EXPECT_EQ(resumed.exit_code, 1);
  EXPECT_THAT(resumed.output,
              LineNames("error:", "benchmark.json", "--max-frames", "4", "0", "--output"));
  ASSERT_EQ(Benchmark("other", {"--max-frames", "5"}).exit_code, 0);
  EXPECT_THAT(Merge({Path("out"), Path("other")}).output,
              LineNames("error:", Path("out"), Path("other"), "--max-frames", "4", "5"));
  EXPECT_THAT(Merge({Path("a")}).output, LineNames("error:", Path("a"), "benchmark*.json"));
  const CommandOutcome shard = Benchmark("out", {"--shard", "3/2"});
  EXPECT_EQ(shard.exit_code, 2);
  EXPECT_THAT(shard.output, LineNames("error:", "--shard", "3/2", "K/N"));
  EXPECT_EQ(RunCommand({"benchmark"}).exit_code, 2);
  EXPECT_EQ(RunCommand({"benchmark", Path("a"), "--merge", Path("out")}).exit_code, 2);
}

// Folders of the layout and the names of the datasets.
TEST_F(BenchmarkCommandTest, ComparesWithTheLiterature) {
  Synthesize("room", 12, "data/tum/rgbd_dataset_freiburg3_structure_notexture_far");
  Synthesize("corridor", 12, "data/living_room_traj0_frei_png");
  const std::string table = std::string(MSC_VO_DATA_FOLDER) + "/benchmarks/msc_vo_paper.yaml";
  const CommandOutcome outcome = RunCommand(
      {"benchmark", table, "--root", Path("data"), "--output", Path("out"), "--max-frames", "10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const std::string published = ReadFile(Path("out/published.md"));
  EXPECT_THAT(outcome.output, HasSubstr(published));
  EXPECT_THAT(published, AllOf(HasSubstr("msc_vo, loops-off | msc_vo, loops-on | MSC-VO | OPVO"),
                               HasSubstr("| 66.0 | 130.0 | 75.0 |"),
                               HasSubstr("- lr-kt1 (ICL-NUIM): wanted as the folder"),
                               HasSubstr("iclnuim.html"), Not(HasSubstr("- snot-far (")),
                               HasSubstr("only the first 10 images")));
  const auto json = nlohmann::json::parse(ReadFile(Path("out/published.json")));
  for (const nlohmann::json& sequence : json["sequences"]) {
    const bool found = sequence["name"] == "lr-kt0" || sequence["name"] == "snot-far";
    EXPECT_EQ(sequence["is_run"], found) << sequence["name"];
    if (!found) continue;
    EXPECT_GT(sequence["msc_vo"]["loops-off"], 0.0);
    EXPECT_LT(sequence["msc_vo"]["loops-on"], 0.05);
  }
  EXPECT_TRUE(HasEntry(Path("out/snot-far/loops-on/trajectory.txt")));
  EXPECT_THAT(ReadFile(Path("out/published.html")), HasSubstr("<td>snot-far</td>"));
  EXPECT_THAT(ReadFile(Path("out/snot-far/loops-off/summary.json")),
              HasSubstr("\"close_loops\": false"));
}

TEST_F(BenchmarkCommandTest, SaysWhatIsWrongWithATable) {
  const std::string table = std::string(MSC_VO_DATA_FOLDER) + "/benchmarks/msc_vo_paper.yaml";
  const auto output = [](const std::vector<std::string>& arguments, int exit_code = 1) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    return outcome.output;
  };
  EXPECT_THAT(output({"benchmark", table}, 2), Names("msc_vo_paper.yaml", "--root"));
  EXPECT_THAT(output({"benchmark", table, "--root", Path("none")}), Names("none"));
  std::filesystem::create_directories(Path("empty"));
  EXPECT_THAT(output({"benchmark", table, "--root", Path("empty"), "--output", Path("out")}),
              Names("none of the 12 sequences", "iclnuim.html", "cvg.cit.tum.de"));
  WriteText("bad.yaml", "title: x\ndatasets: 3\n");
  EXPECT_THAT(output({"benchmark", Path("bad.yaml"), "--root", Path("empty")}),
              Names("bad.yaml:2", "datasets"));
  EXPECT_THAT(output({"benchmark", table, "--root", Path("empty"), "--modes", "pl-vo"}, 2),
              Names("--modes"));
}

}  // namespace
}  // namespace msc_vo
