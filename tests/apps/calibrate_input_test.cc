// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Sequences and files that `calibrate` refuses.

#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/apps/sample_room.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CalibrateInputTest : public TemporaryFolder {
 protected:
  void ExpectRefused(std::vector<std::string> arguments, const NamesMatcher& names) {
    arguments.insert(arguments.begin(), "calibrate");
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << testing::PrintToString(arguments);
    // Before any image is tracked.
    EXPECT_THAT(outcome.output, AllOf(names, Not(HasSubstr("round"))));
  }
  void Synthesize(const std::string& name, const std::string& num_frames) {
    RenderSequence(Path(name), {"--frames", num_frames, "--width", "160"});
  }
};

TEST_F(CalibrateInputTest, RefusesSequencesOfDifferentCameras) {
  Synthesize("other", "2");
  ExpectRefused({kRoom, Path("other")}, Names(Path("other"), kRoom, "calibration"));
}

TEST_F(CalibrateInputTest, RefusesASequenceThatIsGivenTwice) {
  fs::create_directory_symlink(kRoom, Path("link"));
  ExpectRefused({kRoom, kRoom + "/."}, Names(kRoom + "/.", "twice"));
  ExpectRefused({kRoom, Path("link")}, Names(Path("link"), kRoom, "twice"));
}

TEST_F(CalibrateInputTest, RefusesSequencesWithoutPairs) {
  Synthesize("short", "3");
  const std::string camera = Path("camera.yaml"), page = Path("page.html");
  for (const char* count : {"1", "2", "3"}) {
    const CommandOutcome outcome =
        RunCommand({"calibrate", kRoom, "--max-frames", count, "--output", camera, "--plot", page});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_THAT(outcome.output, LineNames("error:", kRoom, count, "images", "0 pairs"));
    EXPECT_FALSE(HasEntry(camera) || HasEntry(page));
  }
}

// As `replay` does, unless it is told not to check.
TEST_F(CalibrateInputTest, RefusesValuesThatAreNoDepths) {
  const std::string folder = Path("disparity"), camera = Path("camera.yaml");
  Synthesize("disparity", "8");
  for (const auto& entry : fs::directory_iterator(folder + "/depth")) {
    cv::Mat depth = cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
    depth.forEach<uint16_t>([](uint16_t& value, const int*) {
      if (value > 0) value = cv::saturate_cast<uint16_t>(8e7 / value);
    });
    ASSERT_TRUE(cv::imwrite(entry.path().string(), depth));
  }
  ExpectRefused({folder, "--output", camera}, Names(folder, "inverse depth"));
  EXPECT_FALSE(HasEntry(camera));
  const CommandOutcome refused = RunCommand({"replay", folder, "--output", Path("out")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.output, LineNames("error:", "depth_scale", "disparity"));
  const CommandOutcome forced =
      RunCommand({"replay", folder, "--no-check", "--output", Path("out")});
  EXPECT_THAT(forced.output, Not(Names("inverse depth")));
}

// Of a camera whose focal length is given as that of another image size.
TEST_F(CalibrateInputTest, WritesNoCameraBeyondTheBounds) {
  const std::string camera = Path("camera.yaml");
  const CommandOutcome outcome =
      RunCommand({"calibrate", kRoom, "--set", "camera.fx=1050", "--set", "camera.fy=1050", "--set",
                  "camera.cx=319.5", "--set", "camera.cy=239.5", "--set", "camera.depth_scale=5000",
                  "--output", camera});
  EXPECT_NE(outcome.exit_code, 0) << outcome.output;
  EXPECT_FALSE(HasEntry(camera)) << outcome.output;
}

TEST_F(CalibrateInputTest, TestsItsOutputsBeforeTheWork) {
  ExpectRefused({kRoom, "--output", Path("no/camera.yaml")}, Names("camera.yaml", "written"));
  ExpectRefused({kRoom, "--plot", Path("no/page.html")}, Names("page.html", "written"));
  ExpectRefused({kRoom, "--output", Folder()}, Names(Folder(), "a folder"));
  const CommandOutcome same =
      RunCommand({"calibrate", kRoom, "--output", Path("a.svg"), "--plot", Path("a.svg")});
  EXPECT_EQ(same.exit_code, 2);
  EXPECT_THAT(same.output, LineNames("error:", "a.svg", "--output", "--plot"));
}

TEST_F(CalibrateInputTest, DoesNotOverwriteItsInput) {
  Synthesize("sequence", "2");
  const std::string sequence = Path("sequence"), camera = sequence + "/camera.txt";
  const std::string before = ReadFile(camera);
  for (const char* name : {"/camera.txt", "/rgb.txt", "/depth/1.000000.png"}) {
    ExpectRefused({sequence, "--output", sequence + name}, Names(sequence + name, "input"));
  }
  ExpectRefused({sequence, "--output", camera, "--camera-file", camera}, Names(camera, "input"));
  ExpectRefused({sequence, "--plot", sequence + "/rgb/page.html"}, Names("page.html", "images"));
  EXPECT_EQ(ReadFile(camera), before);
}

TEST_F(CalibrateInputTest, WritesBesideItsInput) {
  fs::copy(kRoom, Path("room"), fs::copy_options::recursive);
  const std::string camera = Path("room/camera.yaml");
  for (int i = 0; i < 2; ++i) {  // also over an earlier result
    const CommandOutcome outcome =
        RunCommand({"calibrate", Path("room"), "--quiet", "--output", camera});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_TRUE(HasEntry(camera));
  }
}

TEST_F(CalibrateInputTest, TakesTheDepthSensor) {
  for (const char* command : {"calibrate", "check"}) {
    CommandOutcome outcome = RunCommand({command, kRoom, "--depth-sensor", "radar"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, HasSubstr("radar"));
    outcome = RunCommand({command, kRoom, "--depth-sensor", "tof"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
}

}  // namespace
}  // namespace msc_vo
