// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/results/ply_file.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class EvaluateCommandTest : public TemporaryFolder {
 protected:
  // Ground truth: a square around the origin. Estimate: the same, shifted by 1 m. An edge 2 m
  // ahead.
  void SetUp() override {
    TemporaryFolder::SetUp();
    std::string truth, estimate;
    const std::pair<int, int> corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (int i = 0; i < 4; ++i) {
      const std::string time = std::to_string(i), y = std::to_string(corners[i].second);
      truth += time + " " + std::to_string(corners[i].first) + " " + y + " 0 0 0 0 1\n";
      estimate += time + " " + std::to_string(corners[i].first + 1) + " " + y + " 0 0 0 0 1\n";
    }
    WriteText("truth.txt", truth);
    WriteText("estimate.txt", estimate);
    WriteText("edges.ply", FormatEdgesPly({{{0, -1, 2}, {0, 1, 2}}, {{5, 0, 2}, {5, 1, 2}}}));
    MapLine line{{{1, -1, 2.03}, {1, 1, 2.03}}, 9, true, std::nullopt, {0, 0, 1}};
    MapLine seen_once = line;
    seen_once.num_observations = 1;
    MapLine elsewhere = line;
    elsewhere.segment = {{1.5, -1, 2}, {1.5, 1, 2}};
    WriteText("lines.ply", FormatLinesPly({line, seen_once, elsewhere}));
  }
  CommandOutcome Evaluate(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"evaluate", Path("truth.txt"), Path("estimate.txt")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
};

TEST_F(EvaluateCommandTest, ComparesLines) {
  const std::vector<std::string> files = {"--lines", Path("lines.ply"), "--edges",
                                          Path("edges.ply")};
  const CommandOutcome table = Evaluate(files);
  EXPECT_EQ(table.exit_code, 0) << table.output;
  EXPECT_THAT(table.output,
              AllOf(HasSubstr("line distance           30.000"),
                    HasSubstr("lines: 3 in the map, 2 with enough observations and length, 1 of "
                              "these matched with an edge; 1 of 2 edges found")));
  const CommandOutcome text = Evaluate({files[0], files[1], files[2], files[3], "--json"});
  EXPECT_EQ(text.exit_code, 0) << text.output;
  const nlohmann::json json = nlohmann::json::parse(text.output);
  EXPECT_EQ(json["matched"], 4);
  const nlohmann::json lines = json["lines"];
  EXPECT_EQ(lines["count"], 3);
  EXPECT_EQ(lines["counted"], 2);
  EXPECT_EQ(lines["matched"], 1);
  EXPECT_EQ(lines["edges"], 2);
  EXPECT_EQ(lines["edges_found"], 1);
  EXPECT_NEAR(lines["direction_deg"]["rmse"], 0.0, 1e-6);
  EXPECT_NEAR(lines["distance"]["rmse"], 0.03, 1e-9);
  EXPECT_NEAR(lines["distance"]["median"], 0.03, 1e-9);
  EXPECT_NEAR(lines["distance_across"]["max"], 0.0, 1e-9);
}

TEST_F(EvaluateCommandTest, SkipsUnestimatedPosesByDefault) {
  WriteText("estimate.txt",
            ReadFile(Path("estimate.txt")) + "# not estimated\n3.01 9 9 9 0 0 0 1\n");
  WriteText("truth.txt", ReadFile(Path("truth.txt")) + "3.01 1 -1 0 0 0 0 1\n");
  const CommandOutcome marked = Evaluate({});
  EXPECT_EQ(marked.exit_code, 0) << marked.output;
  EXPECT_THAT(marked.output,
              AllOf(HasSubstr("coverage 80.00 %"),
                    HasSubstr("skipped: 1 poses marked as not estimated (--all-poses")));
  EXPECT_NEAR(nlohmann::json::parse(Evaluate({"--json"}).output)["ape_rmse"], 0.0, 1e-9);
  const nlohmann::json all = nlohmann::json::parse(Evaluate({"--all-poses", "--json"}).output);
  EXPECT_EQ(all["coverage"], 1.0);
  EXPECT_GT(all["ape_rmse"], 1.0);
}

TEST_F(EvaluateCommandTest, PrintsNullForMissingNumbers) {
  WriteText("lines.ply", FormatLinesPly({}));
  const CommandOutcome text =
      Evaluate({"--lines", Path("lines.ply"), "--edges", Path("edges.ply"), "--json"});
  const nlohmann::json lines = nlohmann::json::parse(text.output)["lines"];
  EXPECT_EQ(lines["matched"], 0);
  EXPECT_TRUE(lines["distance"]["rmse"].is_null());
  EXPECT_THAT(Evaluate({"--lines", Path("lines.ply"), "--edges", Path("edges.ply")}).output,
              HasSubstr("lines: 0 in the map"));
}

TEST_F(EvaluateCommandTest, ComparesLinesOnlyOnRequest) {
  const CommandOutcome text = Evaluate({"--json"});
  EXPECT_FALSE(nlohmann::json::parse(text.output).contains("lines"));
  EXPECT_EQ(Evaluate({"--lines", Path("lines.ply")}).exit_code, 2);
  EXPECT_EQ(Evaluate({"--edges", Path("edges.ply")}).exit_code, 2);
}

TEST_F(EvaluateCommandTest, ReportsInvalidFiles) {
  const CommandOutcome outcome =
      Evaluate({"--lines", Path("edges.ply"), "--edges", Path("edges.ply")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("msc_vo: error: "), HasSubstr("edges.ply:4: element "
                                                                            "'vertex' has no")));
}

TEST_F(EvaluateCommandTest, ReadsEdgesOfASyntheticSequence) {
  const CommandOutcome outcome =
      RunCommand({"synthesize", Path("bare"), "--scene", "bare", "--frames", "1", "--width", "64"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_GT(ReadEdgesPly(Path("bare/edges.ply")).size(), 100u);
}

}  // namespace
}  // namespace msc_vo
