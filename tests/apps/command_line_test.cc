// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Help, exit codes and error messages of all sub-commands.

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/apps/command_process.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CommandLineTest : public TemporaryFolder {};

// Runs a command that ends with an option, with its value.
CommandOutcome RunWithValue(std::vector<std::string> command, const std::string& value) {
  command.back() += "=" + value;
  return RunCommand(command);
}

// The names that begin the lines of a part of a help text.
std::vector<std::string> NamesIn(const std::string& help, const std::string& part) {
  const size_t begin = help.find("\n" + part + ":\n");
  if (begin == std::string::npos) return {};
  const std::string lines = help.substr(begin + 1, help.find("\n\n", begin) - begin);
  const std::regex name("\n  ([A-Za-z][A-Za-z-]*)");
  std::vector<std::string> names;
  for (std::sregex_iterator line(lines.begin(), lines.end(), name), end; line != end; ++line) {
    names.push_back((*line)[1]);
  }
  return names;
}

TEST_F(CommandLineTest, PrintsHelpForEveryCommand) {
  const std::vector<std::string> commands = NamesIn(RunCommand({"--help"}).output, "Subcommands");
  EXPECT_THAT(commands, testing::IsSupersetOf({"replay", "evaluate", "check", "export"}));
  for (const std::string& command : commands) {
    const CommandOutcome outcome = RunCommand({command, "--help"});
    EXPECT_EQ(outcome.exit_code, 0) << command;
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("\n  msc_vo " + command),
                                      Names("Exit codes", "0", "1", "2", "3", "130")));
    // Newer versions of CLI11 refuse to have an argument and an option of one name.
    for (const std::string& argument : NamesIn(outcome.output, "Positionals")) {
      EXPECT_THAT(outcome.output,
                  testing::Not(testing::ContainsRegex("\n  (-.,)?--" + argument + "[ ,]")))
          << command;
    }
  }
  EXPECT_THAT(RunCommand({"--version"}).output, testing::StartsWith("msc_vo "));
}

TEST_F(CommandLineTest, ReturnsTwoForInvalidArguments) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"fly"},
      {"replay"},
      {"replay", "x", "--fast"},
      {"replay", "x", "--format", "kitti"},
      {"replay", "x", "--mode", "orb"},
      {"replay", "x", "--max-frames", "-3"},
      {"evaluate", "one.txt"},
      {"check"},
      {"solve-window"},
      {"evaluate", "a", "b", "--lines", "c", "--edges", "d", "--align", "none"},
      {"replay", "--view", "x"},
      {"export", "x", "tum", "y", "--voxel", "1"},
      {"benchmark", "x", "--root", "y"},
      {"calibrate", "x", "--set", "modee=pl-vo"}};
  for (const std::vector<std::string>& arguments : wrong) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_FALSE(outcome.output.empty());
  }
}

TEST_F(CommandLineTest, RefusesNumbersOutOfRange) {
  const std::vector<std::vector<std::string>> commands = {
      {"synthesize", Path("room"), "--fps"},
      {"synthesize", Path("room"), "--speed"},
      {"synthesize", Path("room"), "--width"},
      {"synthesize", Path("room"), "--height"},
      {"synthesize", Path("room"), "--seed"},
      {"synthesize", Path("room"), "--image-sigma"},
      {"synthesize", Path("room"), "--focal-length"},
      {"synthesize", Path("room"), "--depth-delay"},
      {"synthesize", Path("room"), "--readout-time"},
      {"synthesize", Path("room"), "--light"},
      {"synthesize", Path("room"), "--motion-blur"},
      {"synthesize", Path("room"), "--depth-bias"},
      {"synthesize", Path("room"), "--depth-factor"},
      {"replay", Path("room"), "--max-frames"},
      {"replay", Path("room"), "--checkpoint-interval"},
      {"replay", Path("room"), "--gravity", "--gravity-sigma"},
      {"evaluate", Path("truth.txt"), Path("estimate.txt"), "--delta"},
      {"evaluate", Path("truth.txt"), Path("estimate.txt"), "--max-dt"},
      {"check", Path("room"), "--images"},
      {"fuse", Path("room"), Path("trajectory.txt"), "--output", Path("mesh.ply"), "--voxel"},
      {"fuse", Path("room"), Path("trajectory.txt"), "--output", Path("mesh.ply"), "--max-depth"}};
  for (const std::vector<std::string>& command : commands) {
    for (const char* value : {"-2", "nan", "inf", "1e300"}) {
      const CommandOutcome outcome = RunWithValue(command, value);
      EXPECT_EQ(outcome.exit_code, 2) << command.back() << "=" << value << "\n" << outcome.output;
      EXPECT_THAT(outcome.output, HasSubstr(command.back()));
    }
  }
  EXPECT_FALSE(std::filesystem::exists(Path("room")));
}

TEST_F(CommandLineTest, SaysWhichNumbersMustBeWhole) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"synthesize", Path("room"), "--frames"},
           {"synthesize", Path("room"), "--seed"},
           {"synthesize", Path("room"), "--path"},
           {"synthesize", Path("room"), "--width"},
           {"synthesize", Path("room"), "--height"},
           {"synthesize", Path("room"), "--stride"},
           {"synthesize", Path("room"), "--jpeg", "--jpeg-quality"},
           {"replay", "x", "--max-frames"},
           {"check", "x", "--images"},
           {"record", "x", Path("room"), "--max-frames"},
           {"export", "x", "tum", "y", "--every"},
           {"fuse", "x", "y", "--output", Path("mesh.ply"), "--every"},
           {"fuse", "x", "y", "--output", Path("mesh.ply"), "--min-observations"}}) {
    for (const char* value : {"1.5", "1e16", "-1", "abc"}) {
      const CommandOutcome outcome = RunWithValue(command, value);
      EXPECT_EQ(outcome.exit_code, 2) << command.back() << "=" << value;
      EXPECT_THAT(outcome.output, LineNames(command.back(), "whole number from", value));
    }
  }
  // The largest number, and whole numbers in other forms.
  const CommandOutcome outcome =
      RunCommand({"synthesize", Path("room"), "--seed", "1e15", "--width", "6.4e1", "--frames",
                  "010", "--stride", "10"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json truth = nlohmann::json::parse(ReadFile(Path("room/truth.json")));
  EXPECT_EQ(truth["seed"], 1000000000000000);
  EXPECT_EQ(truth["camera"]["width"], 64);
  EXPECT_EQ(truth["options"]["frames"], "10");
}

TEST_F(CommandLineTest, SuggestsSimilarCommands) {
  EXPECT_THAT(RunCommand({"repaly", "x"}).output,
              Names("error:", "'repaly'", "'replay'", "evaluate"));
  const std::string output = RunCommand({"fly"}).output;
  EXPECT_THAT(output, LineNames("error:", "'fly'"));
  EXPECT_THAT(LineNaming("'fly'", output), testing::Not(HasSubstr("?")));  // no suggestion
}

TEST_F(CommandLineTest, ExplainsInvalidMaxFrames) {
  const CommandOutcome outcome = RunCommand({"replay", "x", "--max-frames", "0"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, LineNames("--max-frames", "1", "0"));
}

TEST_F(CommandLineTest, WarnsAboutOptionsDeterminedByTheMode) {
  const auto output = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"replay", "--print-config"});
    return RunCommand(arguments).output;
  };
  EXPECT_THAT(output({"--mode", "pl-vo", "--no-manhattan"}),
              LineNames("warning:", "mapping.axes.enabled=false", "mode=pl-vo"));
  EXPECT_THAT(output({"--mode", "pl-vo", "--set", "mapping.axes.enabled=true"}),
              LineNames("warning:", "mapping.axes.enabled=true", "mode=pl-vo", "false"));
  EXPECT_THAT(output({"--no-manhattan"}), testing::Not(HasSubstr("warning")));
  EXPECT_THAT(output({"--mode", "pl-vo"}), testing::Not(HasSubstr("warning")));
}

TEST_F(CommandLineTest, ReturnsOneForInvalidInput) {
  WriteText("bad.txt", "1 2 3\n");
  WriteText("bad.yaml", "tracking:\n  wide_raduis: 3\n");
  const auto expect_error = [](const std::vector<std::string>& arguments,
                               const NamesMatcher& names) {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    EXPECT_THAT(outcome.output, AllOf(Names("error:"), names));
  };
  expect_error({"replay", Path("nowhere")}, Names(Path("nowhere"), "exist"));
  expect_error({"check", Folder()}, Names(Folder(), "RGB-D sequence"));
  expect_error({"evaluate", Path("bad.txt"), Path("bad.txt")}, Names("bad.txt:1", "8"));
  expect_error({"replay", "x", "--config", Path("bad.yaml")},
               Names("bad.yaml:2", "tracking.wide_raduis", "tracking.wide_radius"));
}

TEST_F(CommandLineTest, ReturnsTwoForInvalidSettings) {
  const auto expect_error = [](const std::string& setting, const NamesMatcher& names) {
    const CommandOutcome outcome = RunCommand({"replay", "x", "--set", setting});
    EXPECT_EQ(outcome.exit_code, 2) << setting;
    EXPECT_THAT(outcome.output, AllOf(Names("error:", "--set"), names));
  };
  expect_error("tracking.wide_raduis=3", Names("tracking.wide_radius"));
  expect_error("tracking.wide_radius=a", Names("tracking.wide_radius", "0.1", "1000", "'a'"));
  expect_error("mode", Names("NAME=VALUE"));
}

TEST_F(CommandLineTest, EvaluatesATrajectory) {
  std::string truth, estimate;
  const std::string xy[] = {"1 1", "-1 1", "-1 -1", "1 -1"};
  for (int i = 0; i < 4; ++i) {
    const std::string time = std::to_string(i);
    truth += time + " " + xy[i] + " 0 0 0 0 1\n";
    estimate += time + " " + xy[i] + (i % 2 == 0 ? " 0.1" : " -0.1") + " 0 0 0 1\n";
  }
  WriteText("truth.txt", truth + "9 0 0 0 0 0 0 1\n");
  WriteText("estimate.txt", estimate);
  const CommandOutcome table = RunCommand({"evaluate", Path("truth.txt"), Path("estimate.txt")});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.output, AllOf(Names("100.000"), LineNames("coverage", "80.00 %")));
  const CommandOutcome json =
      RunCommand({"evaluate", Path("truth.txt"), Path("estimate.txt"), "--json"});
  EXPECT_EQ(json.exit_code, 0);
  const nlohmann::json numbers = nlohmann::json::parse(json.output);
  EXPECT_NEAR(numbers["ape_rmse"], 0.1, 1e-9);
  EXPECT_EQ(numbers["matched"], 4);

  WriteText("holes.txt", "10 nan 0 0 0 0 0 1\n11 0 0 inf 0 0 0 1\n" + estimate);
  EXPECT_THAT(RunCommand({"evaluate", Path("truth.txt"), Path("holes.txt")}).output,
              LineNames("2", "holes.txt", "nan"));
  const nlohmann::json holes = nlohmann::json::parse(
      RunCommand({"evaluate", Path("truth.txt"), Path("holes.txt"), "--json"}).output);
  EXPECT_EQ(holes["est_skipped"], 2);
  EXPECT_EQ(holes["gt_skipped"], 0);

  std::string nanoseconds, seconds;
  for (int i = 0; i < 4; ++i) {
    const std::string time = std::to_string(1305031100 + i), pose = " " + xy[i] + " 0 0 0 0 1\n";
    nanoseconds += time + "000000000" + pose;
    seconds += time + pose;
  }
  WriteText("nanoseconds.txt", nanoseconds);
  WriteText("seconds.txt", seconds);
  EXPECT_THAT(RunCommand({"evaluate", Path("nanoseconds.txt"), Path("seconds.txt")}).output,
              AllOf(LineNames("nanoseconds.txt", "are nanoseconds"), LineNames("coverage", "4")));

  WriteText("later.txt", "100 0 0 0 0 0 0 1\n");
  const CommandOutcome none = RunCommand({"evaluate", Path("truth.txt"), Path("later.txt")});
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.output, LineNames("error:", "0", "1"));
}

TEST_F(CommandLineTest, PrintsAConfigurationThatCanBeRead) {
  const CommandOutcome defaults = RunCommand({"replay", "--print-config", "--all"});
  EXPECT_EQ(defaults.exit_code, 0);
  WriteText("all.yaml", defaults.output);
  const CommandOutcome read =
      RunCommand({"replay", "--print-config", "--all", "--config", Path("all.yaml")});
  EXPECT_EQ(read.output, defaults.output);
  const CommandOutcome changed =
      RunCommand({"replay", "--print-config", "--all", "--lines", "lsd", "--no-points", "--set",
                  "tracking.wide_radius=77", "--set", "camera.fx=500"});
  EXPECT_THAT(changed.output, AllOf(HasSubstr("detector: lsd"), HasSubstr("use_points: false"),
                                    HasSubstr("wide_radius: 77"), HasSubstr("  fx: 500")));
  EXPECT_THAT(RunCommand({"replay", "--print-config"}).output,
              AllOf(HasSubstr("prediction_radius: 15"), testing::Not(HasSubstr("wide_radius"))));
}

TEST_F(CommandLineTest, PrintsTheOptionsInMarkdown) {
  const CommandOutcome table = RunCommand({"replay", "--print-config", "--all", "--markdown"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_THAT(table.output, HasSubstr("| `tracking.wide_radius` | `60` |"));
  const CommandOutcome changed =
      RunCommand({"replay", "--print-config", "--markdown", "--no-points"});
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_THAT(changed.output, Names("--markdown", "--config", "--set"));
  EXPECT_EQ(RunCommand({"replay", "x", "--all"}).exit_code, 2);
}

TEST_F(CommandLineTest, ChecksASequence) {
  for (int i = 0; i < 3; ++i) {
    WriteColor("rgb/" + std::to_string(i) + ".png");
    WriteDepth("depth/" + std::to_string(i) + ".png", 10000);
  }
  EXPECT_THAT(RunCommand({"check", Folder()}).output, Names("error:", "camera.txt", "--config"));
  WriteText("camera.txt", "10 10 3.5 2.5 8 6 5000\n");
  RunCommand({"synthesize", Path("room"), "--frames", "6", "--width", "320"});
  const CommandOutcome good = RunCommand({"check", Path("room")});
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_THAT(good.output, Names("0 errors", "0 warnings"));
  WriteImage("depth/1.png", CV_8UC1, 10);
  const CommandOutcome bad = RunCommand({"check", Folder(), "--all"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.output, LineNames("ERROR", "8 bits"));
}

}  // namespace
}  // namespace msc_vo
