// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// What `msc_vo replay` and `msc_vo export` leave, and how they end, if a file cannot be written, if
// there is nothing to export, or if they are interrupted.

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReplayOutputTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    RenderSequence(Path("room"), {"--frames", "12", "--width", "160"});
  }
  CommandOutcome Replay(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"replay", Path("room"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
  // Makes a result that cannot be replaced.
  void Block(const std::string& result) { WriteText(result + "/file", ""); }
};

TEST_F(ReplayOutputTest, FolderThatCannotBeWrittenIsFoundBeforeTheRun) {
  // No user can write into it.
  const CommandOutcome outcome = RunCommand({"replay", Path("room"), "--output", "/proc"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", "/proc/"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("12/12")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("results so far")));
}

TEST_F(ReplayOutputTest, ExportsAreWrittenThoughTheReportIsNot) {
  Block("out/report.html");
  const CommandOutcome outcome =
      Replay({"--output", Path("out"), "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("report.html"));
  EXPECT_EQ(ReadTrajectory(Path("poses.txt")).size(), 12u);
  EXPECT_FALSE(HasEntry(Path("out/checkpoint")));
}

TEST_F(ReplayOutputTest, ExportsAreNotMadeOfIncompleteResults) {
  Block("out/lines.ply");
  const CommandOutcome outcome = Replay({"--output", Path("out"), "--checkpoint-interval", "0",
                                         "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, Names("lines.ply", "msc_vo replay --resume " + Path("out")));
  EXPECT_FALSE(HasEntry(Path("poses.txt")));
  fs::remove_all(Path("out/lines.ply"));
  EXPECT_EQ(RunCommand({"replay", "--quiet", "--resume", Path("out")}).exit_code, 0);
  EXPECT_EQ(ReadTrajectory(Path("poses.txt")).size(), 12u);
}

TEST_F(ReplayOutputTest, FailedTrackingIsNotHiddenByAnExportWithoutPoses) {
  for (const std::string& image : ListFolder(Path("room/rgb"))) {
    WriteImage("room/rgb/" + fs::path(image).filename().string(), CV_8UC3, 0, 160, 120);
  }
  const CommandOutcome outcome =
      Replay({"--output", Path("out"), "--export", "tum=" + Path("poses.txt")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, LineNames("--export tum=", "msc_vo export"));
  EXPECT_FALSE(HasEntry(Path("poses.txt")));
}

TEST_F(ReplayOutputTest, CommandsCanBeCopiedIntoAShell) {
  Block("it's out/lines.ply");
  const CommandOutcome outcome =
      Replay({"--output", Path("it's out"), "--checkpoint-interval", "0"});
  const std::string quoted = "'" + Path("it'\\''s out") + "'";
  EXPECT_THAT(outcome.output, HasSubstr("--resume " + quoted));
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("it's out/summary.json")));
  EXPECT_THAT(summary.at("command_line").get<std::string>(), HasSubstr("--output " + quoted));
}

TEST_F(ReplayOutputTest, ReportHasTheNameOfTheSequence) {
  EXPECT_EQ(RunCommand({"replay", Path("room/."), "--quiet", "--output", Path("out")}).exit_code,
            0);
  EXPECT_THAT(ReadFile(Path("out/report.html")), HasSubstr("<title>room"));
}

#ifdef MSC_VO_HAS_FUSION
// A sequence whose images cannot be read when its depth is fused. The warnings do not fit into a
// pipe: the fusion waits for a test that does not read them, and is interrupted on any machine.
class FusionOfManyImagesTest : public ReplayOutputTest {
 protected:
  void SetUp() override {
    ReplayOutputTest::SetUp();
    const auto copy = [this](const std::string& from, const std::string& to) {
      fs::create_directories(fs::path(Path(to)).parent_path());
      fs::copy_file(from, Path(to));
    };
    const std::string color = ListFolder(Path("room/rgb")).front();
    copy(color, "still/rgb/first.png");
    copy(color, "still/" + image_);
    copy(Path("room/depth/" + fs::path(color).filename().string()), "still/depth/all.png");
    copy(Path("room/camera.txt"), "still/camera.txt");
    std::string list = "0.000000 rgb/first.png 0.000000 depth/all.png\n";
    for (int i = 1; i < 250; ++i) {
      const std::string stamp = FormatText("%.6f ", 0.04 * i);
      list += stamp + image_ + " " + stamp + "depth/all.png\n";
    }
    WriteText("still/associations.txt", list);
  }
  void DamageImages() { WriteText("still/" + image_, "damaged"); }
  // Interrupts the fusion. Returns the exit code.
  int Interrupt(CommandProcess* process) {
    EXPECT_TRUE(process->WaitForOutput(image_));
    process->Signal(SIGINT);
    return process->Wait();
  }

 private:
  const std::string image_ = "rgb/" + std::string(240, 'x') + ".png";
};

TEST_F(FusionOfManyImagesTest, ThatIsInterruptedIsNoError) {
  ASSERT_EQ(RunCommand({"replay", Path("still"), "--quiet", "--output", Path("out")}).exit_code, 0);
  DamageImages();
  CommandProcess process({"export", Path("out"), "ply", Path("cloud.ply")});
  EXPECT_EQ(Interrupt(&process), 130);
  EXPECT_FALSE(HasEntry(Path("cloud.ply")));
}

TEST_F(FusionOfManyImagesTest, ThatIsInterruptedNamesTheExportsThatAreLeft) {
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  const std::string ply = "ply=" + Path("cloud.ply"), tum = "tum=" + Path("poses.txt");
  CommandProcess replay({"replay", Path("still"), "--json", "--output", Path("out"), "--export",
                         ply, "--export", tum},
                        Path("pipe"));
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(fopen(Path("pipe").c_str(), "r"), fclose);
  ASSERT_GT(fcntl(fileno(pipe.get()), F_SETPIPE_SZ, 4096), 0);
  ASSERT_EQ(setvbuf(pipe.get(), nullptr, _IONBF, 0), 0);
  ASSERT_EQ(fgetc(pipe.get()), '{');  // the run has ended, and waits for the rest to be read
  DamageImages();
  char line[4096];
  do {
    ASSERT_NE(fgets(line, sizeof(line), pipe.get()), nullptr);
  } while (line != std::string("}\n"));
  EXPECT_EQ(Interrupt(&replay), 130);
  EXPECT_THAT(replay.output(), LineNames("--export " + ply, "--export " + tum, "msc_vo export"));
  EXPECT_FALSE(HasEntry(Path("poses.txt")));
}
#endif

}  // namespace
}  // namespace msc_vo
