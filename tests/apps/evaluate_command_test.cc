// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// The JSON behind the warnings.
nlohmann::json JsonOf(const CommandOutcome& outcome) {
  return nlohmann::json::parse(outcome.output.substr(outcome.output.find('{')));
}

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
  EXPECT_THAT(LineNaming("line distance", table.output), Names("30.000"));
  EXPECT_THAT(LineNaming("lines:", table.output), Names("3", "2", "1"));
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
              AllOf(LineNames("coverage", "80.00 %"), LineNames("1", "--all-poses")));
  EXPECT_NEAR(JsonOf(Evaluate({"--json"}))["ape_rmse"], 0.0, 1e-9);
  const nlohmann::json all = JsonOf(Evaluate({"--all-poses", "--json"}));
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
  const std::string table =
      Evaluate({"--lines", Path("lines.ply"), "--edges", Path("edges.ply")}).output;
  EXPECT_THAT(LineNaming("lines:", table), Names("0"));
}

TEST_F(EvaluateCommandTest, ComparesLinesOnlyOnRequest) {
  const CommandOutcome text = Evaluate({"--json"});
  EXPECT_FALSE(nlohmann::json::parse(text.output).contains("lines"));
  EXPECT_EQ(Evaluate({"--lines", Path("lines.ply")}).exit_code, 2);
  EXPECT_EQ(Evaluate({"--edges", Path("edges.ply")}).exit_code, 2);
}

TEST_F(EvaluateCommandTest, AlignsAsRequested) {
  const auto rmse = [&](const std::string& alignment) {
    return JsonOf(Evaluate({"--align", alignment, "--json"}))["ape_rmse"].get<double>();
  };
  // The estimate is 1 m beside the truth.
  EXPECT_NEAR(rmse("se3"), 0.0, 1e-9);
  EXPECT_NEAR(rmse("sim3"), 0.0, 1e-9);
  EXPECT_NEAR(rmse("origin"), 0.0, 1e-9);
  EXPECT_NEAR(rmse("none"), 1.0, 1e-9);
  WriteText("estimate.txt",
            "0 0.5 0.5 0 0 0 0 1\n1 -0.5 0.5 0 0 0 0 1\n2 -0.5 -0.5 0 0 0 0 1\n"
            "3 0.5 -0.5 0 0 0 0 1\n");
  EXPECT_NEAR(rmse("se3"), std::sqrt(0.5), 1e-9);
  const nlohmann::json json = JsonOf(Evaluate({"--align", "sim3", "--json"}));
  EXPECT_NEAR(json["scale"], 2.0, 1e-9);
  EXPECT_NEAR(json["ape_sse"], 0.0, 1e-9);
  EXPECT_EQ(json["alignment"], "sim3");
  EXPECT_THAT(Evaluate({"--align", "sim3"}).output, LineNames("scale", "2.000000"));
  EXPECT_EQ(Evaluate({"--align", "magic"}).exit_code, 2);
}

TEST_F(EvaluateCommandTest, MeasuresRelativeErrorsOverADelta) {
  // Every step of the estimate is 2 m, as that of the truth, but the last one is 0.5 m longer.
  WriteText("estimate.txt",
            "0 1 1 0 0 0 0 1\n1 -1 1 0 0 0 0 1\n2 -1 -1 0 0 0 0 1\n3 1.5 -1 0 0 0 0 1\n");
  const nlohmann::json frames = JsonOf(Evaluate({"--json"}))["rpe"];
  EXPECT_EQ(frames["pairs"], 3);
  EXPECT_EQ(frames["unit"], "frames");
  EXPECT_NEAR(frames["translation"]["max"], 0.5, 1e-9);
  EXPECT_NEAR(frames["translation"]["min"], 0.0, 1e-9);
  EXPECT_NEAR(frames["translation"]["mean"], 0.5 / 3.0, 1e-9);
  EXPECT_NEAR(frames["translation"]["sse"], 0.25, 1e-9);
  const nlohmann::json seconds = nlohmann::json::parse(
      Evaluate({"--delta", "2", "--delta-unit", "s", "--all-pairs", "--json"}).output)["rpe"];
  EXPECT_EQ(seconds["pairs"], 2);
  EXPECT_NEAR(seconds["translation"]["rmse"], 0.5 / std::sqrt(2.0), 1e-9);
  EXPECT_THAT(Evaluate({"--delta", "4", "--delta-unit", "metres"}).output,
              LineNames("RPE", "4 metres", "no pairs"));
  const CommandOutcome fraction = Evaluate({"--delta", "1.5"});
  EXPECT_EQ(fraction.exit_code, 2);
  EXPECT_THAT(fraction.output, AllOf(Names("--delta", "whole", "1.5", "--delta-unit"),
                                     Not(HasSubstr("rpe_delta")), Not(HasSubstr("evaluation:"))));
  EXPECT_EQ(Evaluate({"--delta", "0"}).exit_code, 2);
}

TEST_F(EvaluateCommandTest, ReadsKittiAndEuroc) {
  WriteText("kitti.txt",
            "1 0 0 1 0 1 0 1 0 0 1 0\n1 0 0 -1 0 1 0 1 0 0 1 0\n1 0 0 -1 0 1 0 -1 0 0 1 0\n"
            "1 0 0 1 0 1 0 -1 0 0 1 0\n");
  std::string euroc = "#timestamp [ns], p_RS_R_x [m], y, z, q_RS_w [], q_RS_x [], y, z\n";
  const char* const positions[] = {"1,1", "-1,1", "-1,-1", "1,-1"};
  for (int i = 0; i < 4; ++i) {
    euroc += std::to_string(i) + "000000000," + positions[i] + ",0,1,0,0,0\n";
  }
  WriteText("euroc.csv", euroc);
  for (const auto& [truth, estimate] : {std::pair("kitti.txt", "truth.txt"),
                                        {"truth.txt", "kitti.txt"},
                                        {"euroc.csv", "truth.txt"},
                                        {"kitti.txt", "kitti.txt"},
                                        {"euroc.csv", "kitti.txt"}}) {
    const CommandOutcome outcome =
        RunCommand({"evaluate", Path(truth), Path(estimate), "--align", "none", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const nlohmann::json json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["matched"], 4) << truth << " " << estimate;
    EXPECT_NEAR(json["ape_max"], 0.0, 1e-12);
  }
  const CommandOutcome table = RunCommand({"evaluate", Path("kitti.txt"), Path("kitti.txt")});
  EXPECT_THAT(LineNaming("formats", table.output), testing::ContainsRegex("kitti.*kitti"));
  EXPECT_THAT(table.output, testing::Not(HasSubstr("mm/s")));
  EXPECT_THAT(
      RunCommand({"evaluate", Path("kitti.txt"), Path("truth.txt"), "--format", "tum"}).output,
      LineNames("error:", "kitti.txt:1", "8"));
  EXPECT_EQ(RunCommand({"evaluate", Path("kitti.txt"), Path("truth.txt"), "--format", "kitti,tum"})
                .exit_code,
            0);
  EXPECT_EQ(RunCommand({"evaluate", "a", "b", "--format", "xml"}).exit_code, 2);
}

// 60 poses along a curve, times and positions multiplied, quaternions x y z w or w x y z.
std::string CurveRows(double seconds, double scale, bool scalar_first, const char* separator) {
  std::string text;
  for (int i = 0; i < 60; ++i) {
    const double t = 0.05 * i;
    const Eigen::Quaterniond q = ExpSO3({0.3 * std::sin(t), t, 0.2});
    const double xyz[] = {q.x(), q.y(), q.z()};
    std::vector<double> values = {seconds * (100.0 + t), scale * std::sin(t), scale * t,
                                  scale * std::cos(2.0 * t)};
    if (scalar_first) values.push_back(q.w());
    values.insert(values.end(), std::begin(xyz), std::end(xyz));
    if (!scalar_first) values.push_back(q.w());
    for (size_t k = 0; k < values.size(); ++k)
      text += (k > 0 ? separator : "") + FormatNumber(values[k]);
    text += "\n";
  }
  return text;
}

TEST_F(EvaluateCommandTest, SaysWhatContradicts) {
  WriteText("truth.txt", CurveRows(1.0, 1.0, false, " "));
  WriteText("estimate.txt", CurveRows(1e3, 5.0, true, ","));
  const CommandOutcome outcome = Evaluate({"--plot", Path("plot.html")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, LineNames("estimate.txt", "milliseconds"));
  EXPECT_THAT(outcome.output, Names("estimated path", "5.0", "depth_scale", "order qw qx qy qz"));
  EXPECT_THAT(ReadFile(Path("plot.html")),
              Names("estimated path", "5.0", "depth_scale", "order qw qx qy qz"));
  const std::string text = Evaluate({"--json", "--align", "origin"}).output;
  const nlohmann::json json = nlohmann::json::parse(text.substr(text.find('{')));
  EXPECT_EQ(json["warnings"].size(), 2u);
  // The scale of sim3 is free, and a header says the order.
  WriteText("estimate.txt", "# time x y z qw qx qy qz\n" + CurveRows(1.0, 5.0, true, ","));
  const CommandOutcome named = Evaluate({"--align", "sim3"});
  EXPECT_THAT(named.output, testing::Not(HasSubstr("warning")));
  EXPECT_THAT(named.output, LineNames("scale", "0.200000"));
}

TEST_F(EvaluateCommandTest, RefusesOrNamesDegenerateAlignments) {
  std::string still;
  for (int i = 0; i < 4; ++i) still += std::to_string(i) + " 3 4 5 0 0 0 1\n";
  WriteText("estimate.txt", ReadFile(Path("truth.txt")));
  WriteText("truth.txt", still);
  const CommandOutcome scale = Evaluate({"--align", "sim3"});
  EXPECT_EQ(scale.exit_code, 1);
  EXPECT_THAT(scale.output, LineNames("error:", "reference", "scale"));
  const CommandOutcome rotation = Evaluate({});
  EXPECT_EQ(rotation.exit_code, 0);
  EXPECT_THAT(rotation.output, LineNames("reference", "rotation"));
  WriteText("estimate.txt", "0 0 0 0 0 0 0 1\n1 1 1 0 0 0 0 1\n2 2 2 0 0 0 0 1\n3 3 3 0 0 0 0 1\n");
  WriteText("truth.txt", ReadFile(Path("estimate.txt")));
  EXPECT_THAT(Evaluate({}).output, LineNames("warning:", "straight line"));
  // Nothing is aligned.
  EXPECT_THAT(Evaluate({"--align", "none"}).output, testing::Not(HasSubstr("straight line")));
}

TEST_F(EvaluateCommandTest, MatchesEqualStampsInOrderOfTheFile) {
  std::string rows;
  for (int i = 0; i < 30; ++i) {
    rows += FormatNumber(0.1 * (i / 3)) + " " + FormatNumber(std::sin(0.1 * i)) + " " +
            FormatNumber(0.1 * i) + " 0 0 0 0 1\n";
  }
  WriteText("truth.txt", rows);
  WriteText("estimate.txt", rows);
  const nlohmann::json json = JsonOf(Evaluate({"--json"}));
  EXPECT_EQ(json["matched"], 30);
  EXPECT_NEAR(json["ape_max"], 0.0, 1e-9);
}

TEST_F(EvaluateCommandTest, WritesPlots) {
  EXPECT_THAT(Evaluate({"--plot", Path("plot.html")}).output, Names(Path("plot.html")));
  EXPECT_THAT(ReadFile(Path("plot.html")),
              AllOf(HasSubstr("<!doctype html>"), HasSubstr("APE RMSE")));
  EXPECT_EQ(Evaluate({"--plot", Path("plot.svg")}).exit_code, 0);
  EXPECT_THAT(ReadFile(Path("plot.svg")), testing::StartsWith("<svg"));
  EXPECT_EQ(Evaluate({"--plot", Path("plot.png")}).exit_code, 2);
  EXPECT_EQ(Evaluate({"--plot", Path("no/plot.svg")}).exit_code, 1);
  std::filesystem::create_symlink(Path("truth.txt"), Path("truth.svg"));
  EXPECT_THAT(Evaluate({"--plot", Path("truth.svg")}).output, LineNames("error:", "truth.svg"));
}

TEST_F(EvaluateCommandTest, SaysWhichFileHasNoPoses) {
  const std::string truth = ReadFile(Path("truth.txt"));
  for (const char* name : {"estimate.txt", "truth.txt"}) {
    WriteText("truth.txt", truth);
    WriteText("estimate.txt", truth);
    for (const char* text : {"", "# timestamp tx ty tz qx qy qz qw\n", "0 nan 0 0 0 0 0 1\n"}) {
      WriteText(name, text);
      const CommandOutcome outcome = Evaluate({});
      EXPECT_EQ(outcome.exit_code, 1);
      EXPECT_THAT(outcome.output, LineNames("error:", Path(name) + ": has no poses"));
      EXPECT_THAT(outcome.output, testing::Not(HasSubstr("clock")));
    }
  }
}

TEST_F(EvaluateCommandTest, FailsOnATrajectoryWithOtherColumns) {
  WriteText("estimate.txt", "1 0.5 0.5 0.5 0.5 1 2 0.3\n2 0.5 0.5 0.5 0.5 2 1 0.3\n");
  const CommandOutcome outcome = Evaluate({});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "estimate.txt:1", "columns 2-5"));
}

TEST_F(EvaluateCommandTest, ReplacesOnlyPlotsOfItsOwn) {
  for (const char* name : {"plot.html", "plot.svg"}) {
    WriteText(name, "<title>another</title>");
    const CommandOutcome outcome = Evaluate({"--plot", Path(name)});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, LineNames("error:", Path(name), "exists", "remove"));
    EXPECT_EQ(ReadFile(Path(name)), "<title>another</title>");
    std::filesystem::remove(Path(name));
    for (int i = 0; i < 2; ++i) EXPECT_EQ(Evaluate({"--plot", Path(name)}).exit_code, 0);
  }
}

TEST_F(EvaluateCommandTest, ReportsInvalidFiles) {
  const CommandOutcome outcome =
      Evaluate({"--lines", Path("edges.ply"), "--edges", Path("edges.ply")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "edges.ply:4", "'vertex'"));
}

TEST_F(EvaluateCommandTest, ReadsEdgesOfASyntheticSequence) {
  const CommandOutcome outcome =
      RunCommand({"synthesize", Path("bare"), "--scene", "bare", "--frames", "1", "--width", "64"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_GT(ReadEdgesPly(Path("bare/edges.ply")).size(), 100u);
}

}  // namespace
}  // namespace msc_vo
