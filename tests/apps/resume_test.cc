// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Runs that are killed or interrupted and resumed. tests/faults/kill_and_resume.py does that at
// hundreds of moments.

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::AllOf;

constexpr int kNumFrames = 40;

class ResumeTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"),
                   {"--scene", "room", "--frames", std::to_string(kNumFrames), "--width", "160"});
    ASSERT_EQ(RunCommand(Command("whole")).exit_code, 0);
  }
  // A new run that saves a checkpoint after every image.
  std::vector<std::string> Command(const std::string& output,
                                   const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "replay", Path("room"), "--quiet", "--checkpoint-interval", "0", "--output", Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  CommandOutcome Resume(const std::string& output, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"replay", "--quiet", "--resume", Path(output)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  int NumRows(const std::string& output) const {
    const std::string path = Path(output + "/frames.csv");
    if (!HasEntry(path)) return 0;
    const std::string rows = ReadFile(path);
    return std::max(0, static_cast<int>(std::count(rows.begin(), rows.end(), '\n')) - 1);
  }
  // Ends a run by a signal when it has written so many frames and the checkpoint of most of them.
  void Stop(const std::string& output, int num_frames, int signal,
            const std::vector<std::string>& more = {}) {
    CommandProcess replay(Command(output, more));
    for (int i = 0; i < 60000 && NumRows(output) < num_frames; ++i) usleep(1000);
    replay.Signal(signal);
    ASSERT_EQ(replay.Wait(), signal == SIGKILL ? -SIGKILL : 130) << replay.output();
    ASSERT_GE(NumRows(output), num_frames);
    ASSERT_TRUE(HasEntry(Path(output + "/checkpoint/state.bin")));
  }
  // The columns of frames.csv but the times of stages.
  std::string FramesWithoutTimes(const std::string& output) const {
    const std::vector<TextLine> rows = ReadTextLines(Path(output + "/frames.csv"));
    const std::vector<std::string>& names = rows.front().fields;
    std::string text;
    for (const TextLine& row : rows) {
      for (size_t i = 0; i < row.fields.size(); ++i) {
        if (names.at(i).find("_ms") == std::string::npos) text += row.fields[i] + " ";
      }
      text += "\n";
    }
    return text;
  }
  void ExpectSameAsWholeRun(const std::string& output) const {
    for (const char* name :
         {"/trajectory.txt", "/keyframes.txt", "/groundtruth.txt", "/map.ply", "/lines.ply"}) {
      EXPECT_EQ(ReadFile(Path(output + name)), ReadFile(Path(std::string("whole") + name))) << name;
    }
    EXPECT_EQ(FramesWithoutTimes(output), FramesWithoutTimes("whole"));
    const auto summary = [this](const std::string& folder) {
      nlohmann::json json = nlohmann::json::parse(ReadFile(Path(folder + "/summary.json")));
      for (const char* name : {"command_line", "cost", "stages", "milliseconds"}) json.erase(name);
      return json;
    };
    EXPECT_EQ(summary(output)["map"], summary("whole")["map"]);
    EXPECT_EQ(summary(output)["frames"], summary("whole")["frames"]);
    EXPECT_EQ(summary(output)["outcome"], "complete");
    EXPECT_FALSE(HasEntry(Path(output + "/checkpoint")));
  }
  void ExpectRefused(const CommandOutcome& outcome, const NamesMatcher& reason) const {
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output,
                AllOf(Names("error:", Path("out/checkpoint/"), "--resume"), reason));
  }
};

TEST_F(ResumeTest, ContinuesAKilledRunToTheSameBytes) {
  // Killed three times, resumed with another number of threads, and by either form of the command.
  Stop("out", 5, SIGKILL, {"--set", "threads=3"});
  {
    CommandProcess replay({"replay", "--resume", Path("out"), "--checkpoint-interval", "0"});
    for (int i = 0; i < 60000 && NumRows("out") < 15; ++i) usleep(1000);
    replay.Signal(SIGKILL);
    EXPECT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
  const int num_rows = NumRows("out");
  EXPECT_GE(num_rows, 15);
  {
    CommandProcess replay({"replay", Path("room"), "--resume", Path("out"), "--set", "threads=1",
                           "--checkpoint-interval", "0"});
    for (int i = 0; i < 60000 && NumRows("out") < 25; ++i) {
      EXPECT_GE(NumRows("out"), num_rows);  // what is on disk stays there
      usleep(1000);
    }
    replay.Signal(SIGKILL);
    EXPECT_EQ(replay.Wait(), -SIGKILL) << replay.output();
  }
  const CommandOutcome outcome = Resume("out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(outcome.output, "");
  ExpectSameAsWholeRun("out");
}

TEST_F(ResumeTest, ContinuesWithTheAccelerometer) {
  // Accelerations are computed from keyframes at least a second apart.
  std::filesystem::remove_all(Path("room"));
  RenderSequence(Path("room"), {"--scene", "room", "--frames", std::to_string(kNumFrames),
                                "--width", "160", "--fps", "5"});
  ASSERT_EQ(RunCommand(Command("whole")).exit_code, 0);
  const std::string without = ReadFile(Path("whole/trajectory.txt"));
  ASSERT_EQ(RunCommand(Command("whole", {"--gravity"})).exit_code, 0);
  ASSERT_NE(ReadFile(Path("whole/trajectory.txt")), without);
  Stop("out", 25, SIGKILL, {"--gravity"});
  const CommandOutcome outcome = Resume("out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  ExpectSameAsWholeRun("out");
}

TEST_F(ResumeTest, ContinuesWithTheLensThatTheRunHasFound) {
  std::filesystem::remove_all(Path("room"));
  RenderSequence(Path("room"), {"--scene", "room", "--frames", "40", "--fps", "5", "--width", "320",
                                "--lens", "radial-tangential:-0.3,0.1,0,0,0", "--untold"});
  ASSERT_EQ(RunCommand(Command("whole")).exit_code, 0);
  const auto calibration = [this](const std::string& output) {
    return nlohmann::json::parse(ReadFile(Path(output + "/summary.json"))).at("self_calibration");
  };
  ASSERT_EQ(calibration("whole").at("k1").at("verdict"), "corrected");
  Stop("out", 35, SIGTERM);
  ASSERT_EQ(calibration("out").at("k1").at("verdict"), "corrected");  // before it is stopped
  EXPECT_EQ(Resume("out").exit_code, 0);
  ExpectSameAsWholeRun("out");
  EXPECT_EQ(calibration("out"), calibration("whole"));
}

TEST_F(ResumeTest, ContinuesAnInterruptedRun) {
  Stop("out", 10, SIGTERM);
  EXPECT_TRUE(HasEntry(Path("out/summary.json")));
  EXPECT_EQ(Resume("out").exit_code, 0);
  ExpectSameAsWholeRun("out");
  const CommandOutcome again = Resume("out");
  ExpectRefused(again, Names("state.bin", "exist"));
}

// The interval of the first run is 0: a checkpoint after every image.
TEST_F(ResumeTest, KeepsTheIntervalOfTheCheckpoints) {
  Stop("out", 5, SIGKILL);
  const std::string output = Resume("out", {"--log-level", "debug"}).output;
  const std::string resumed = "resumed at image ";
  const size_t at = output.find(resumed);
  ASSERT_NE(at, std::string::npos) << output;
  const int num_left = kNumFrames - std::stoi(output.substr(at + resumed.size()));
  int num_checkpoints = 0;
  for (size_t i = 0; (i = output.find("checkpoint of ", i)) != std::string::npos; ++i) {
    ++num_checkpoints;
  }
  EXPECT_EQ(num_checkpoints, num_left);
  EXPECT_GT(num_left, 1);
}

TEST_F(ResumeTest, RefusesAnotherRun) {
  Stop("out", 5, SIGKILL);
  ExpectRefused(RunCommand({"replay", Path("room"), "--resume", Path("out"), "--set",
                            "mapping.latency=0.05"}),
                Names("mapping.latency", "'0.085'", "'0.05'"));
  const CommandOutcome option = Resume("out", {"--no-lines"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.output, Names("--resume", "--no-lines"));
  const CommandOutcome realtime =
      RunCommand({"replay", Path("room"), "--resume", Path("out"), "--realtime"});
  EXPECT_EQ(realtime.exit_code, 2);
  EXPECT_THAT(realtime.output, LineNames("error:", "--resume", "real time"));
  const std::string stamp = ReadTextLines(Path("room/rgb.txt")).at(20).fields.at(1);
  std::filesystem::copy_file(Path("room/" + ReadTextLines(Path("room/rgb.txt")).at(0).fields.at(1)),
                             Path("room/" + stamp),
                             std::filesystem::copy_options::overwrite_existing);
  ExpectRefused(Resume("out"), Names("checksum", "images"));
  EXPECT_EQ(NumRows("out") >= 5, true);  // nothing was touched
}

TEST_F(ResumeTest, RefusesADamagedCheckpointAndReplacesItOnANewRun) {
  Stop("out", 5, SIGKILL);
  std::string state = ReadFile(Path("out/checkpoint/state.bin"));
  state[state.size() / 2] = static_cast<char>(state[state.size() / 2] + 1);
  WriteText("out/checkpoint/state.bin", state);
  ExpectRefused(Resume("out"), Names("state.bin", "damaged"));
  const CommandOutcome outcome = RunCommand(Command("out"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, LineNames("warning:", "unfinished"));
  ExpectSameAsWholeRun("out");
}

}  // namespace
}  // namespace msc_vo
