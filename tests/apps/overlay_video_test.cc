// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The video of `msc_vo replay --overlay`, and the arguments of the live view.

#include <filesystem>

#include "tests/apps/command_process.h"
#include "tests/apps/sample_room.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/videoio.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

class OverlayVideoTest : public TemporaryFolder {
 protected:
  CommandOutcome Replay(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"replay",  kRoom,          "--output", Path("out"),
                                          "--quiet", "--max-frames", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunCommand(arguments);
  }
};

TEST_F(OverlayVideoTest, ShowsEveryImageWithItsFeatures) {
  const std::string file = Path("videos/room.mp4");
  const CommandOutcome outcome = Replay({"--overlay", file});
  if (outcome.exit_code == 1 && outcome.output.find("encoder") != std::string::npos) {
    GTEST_SKIP() << outcome.output;
  }
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  cv::VideoCapture video(file);
  ASSERT_TRUE(video.isOpened());
  int num_images = 0, num_colored = 0;
  for (cv::Mat image; video.read(image); ++num_images) {
    for (int i = 0; i < image.rows * image.cols; ++i) {
      const auto& pixel = image.at<cv::Vec3b>(i / image.cols, i % image.cols);
      const auto [low, high] = std::minmax({pixel[0], pixel[1], pixel[2]});
      num_colored += high - low > 80 ? 1 : 0;  // the images themselves are grey
    }
  }
  EXPECT_EQ(num_images, 8);
  EXPECT_GT(num_colored, 1000);
}

TEST_F(OverlayVideoTest, DoesNotChangeTheTrajectory) {
  ASSERT_EQ(Replay({}).exit_code, 0);
  const std::string plain = ReadFile(Path("out/trajectory.txt"));
  Replay({"--overlay", Path("room.mp4")});
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), plain);
}

TEST_F(OverlayVideoTest, ReplacesAVideoAtTheEndOfTheRun) {
  const std::string earlier(
      "\0\0\0\x20"
      "ftypisom an earlier one",
      27);
  WriteText("room.mp4", earlier);
  WriteText("broken.map", "no map");
  EXPECT_EQ(Replay({"--overlay", Path("room.mp4"), "--map", Path("broken.map")}).exit_code, 1);
  EXPECT_EQ(ReadFile(Path("room.mp4")), earlier);
  const CommandOutcome outcome = Replay({"--overlay", Path("room.mp4")});
  if (outcome.output.find("encoder") != std::string::npos) GTEST_SKIP() << outcome.output;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_TRUE(cv::VideoCapture(Path("room.mp4")).isOpened());
  for (const std::string& path : ListFolder(Folder())) EXPECT_THAT(path, Not(HasSubstr("partial")));
}

TEST_F(OverlayVideoTest, ReplacesOnlyVideos) {
  WriteText("room.mp4", "no video");
  const CommandOutcome outcome = Replay({"--overlay", Path("room.mp4")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, LineNames("error:", Path("room.mp4"), "exists", "--overwrite"));
  EXPECT_EQ(ReadFile(Path("room.mp4")), "no video");
}

TEST_F(OverlayVideoTest, RefusesNamesAndFoldersThatCannotBe) {
  EXPECT_EQ(Replay({"--overlay", Path("room.avi")}).exit_code, 2);
  WriteText("file", "");
  WriteText("folder.mp4/file", "");
  EXPECT_EQ(Replay({"--overlay", Path("folder.mp4")}).exit_code, 1);
  const CommandOutcome outcome = Replay({"--overlay", Path("file/room.mp4")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.output, HasSubstr(Path("file")));
}

TEST_F(OverlayVideoTest, RefusesPortsThatCannotBe) {
  for (const char* port : {"99999", "-1", "http", "1.5"}) {
    const CommandOutcome outcome = Replay({std::string("--view=") + port});
    if (outcome.output.find("built without") != std::string::npos) GTEST_SKIP() << outcome.output;
    EXPECT_EQ(outcome.exit_code, 2) << port;
    EXPECT_THAT(outcome.output, LineNames("error:", "--view", "port"));
  }
  // The sequence is taken for the port.
  EXPECT_THAT(RunCommand({"replay", "--view", kRoom}).output,
              LineNames("error:", "--view", "port"));
  EXPECT_EQ(Replay({"--view-address", "127.0.0.1"}).exit_code, 2);  // without --view
}

TEST_F(OverlayVideoTest, ShowsARunToThisMachineOnly) {
  const CommandOutcome outcome = Replay({"--view", "0"});
  if (outcome.output.find("built without") != std::string::npos) GTEST_SKIP() << outcome.output;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("http://127.0.0.1:"));
}

}  // namespace
}  // namespace msc_vo
