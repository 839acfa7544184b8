// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <csignal>
#include <cstdlib>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <unistd.h>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RecordCommandTest : public TemporaryFolder {
 protected:
  void Synthesize(int num_frames, const std::string& width = "160") {
    RenderSequence(Path("room"), {"--frames", std::to_string(num_frames), "--width", width});
  }
  // Every list names the same number of pairs, whose files exist.
  size_t NumConsistentPairs(const std::string& folder) {
    const std::vector<TextLine> pairs = ReadTextLines(folder + "/associations.txt");
    for (const TextLine& pair : pairs) {
      EXPECT_EQ(pair.fields.size(), 4u);
      EXPECT_TRUE(HasEntry(folder + "/" + pair.fields.at(1)));
      EXPECT_TRUE(HasEntry(folder + "/" + pair.fields.at(3)));
    }
    EXPECT_EQ(ReadTextLines(folder + "/rgb.txt").size(), pairs.size());
    EXPECT_EQ(ReadTextLines(folder + "/depth.txt").size(), pairs.size());
    return pairs.size();
  }
};

TEST_F(RecordCommandTest, CopiesASequence) {
  Synthesize(6);
  const CommandOutcome outcome = RunCommand({"record", Path("room"), Path("copy")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, LineNames("6", Path("copy")));
  EXPECT_EQ(NumConsistentPairs(Path("copy")), 6u);
  EXPECT_EQ(ReadFile(Path("copy/rgb/1.000000.png")), ReadFile(Path("room/rgb/1.000000.png")));
  for (const char* folder : {"room", "copy"}) {
    const CommandOutcome replay = RunCommand(
        {"replay", Path(folder), "--output", Path(std::string("out_") + folder), "--quiet"});
    ASSERT_EQ(replay.exit_code, 0) << replay.output;
  }
  EXPECT_EQ(ReadFile(Path("out_room/trajectory.txt")), ReadFile(Path("out_copy/trajectory.txt")));
}

TEST_F(RecordCommandTest, WritesImagesOfOtherFormatsAsPng) {
  Synthesize(2);
  const cv::Mat color = cv::imread(Path("room/rgb/1.000000.png"), cv::IMREAD_UNCHANGED);
  for (const char* name : {"rgb/1.000000.bmp", "rgb/1.033333.tiff"}) {
    cv::imwrite(Path(std::string("room/") + name), color);
  }
  const std::string depth = "room/depth/1.000000.png", second = "room/depth/1.033333.png";
  ASSERT_TRUE(HasEntry(Path(depth)) && HasEntry(Path(second)));
  WriteText("room/associations.txt",
            "1.0 rgb/1.000000.bmp 1.0 depth/1.000000.png\n"
            "1.033333 rgb/1.033333.tiff 1.033333 depth/1.033333.png\n");
  EXPECT_EQ(RunCommand({"record", Path("room"), Path("copy")}).exit_code, 0);
  for (const char* name : {"copy/rgb/1.000000.png", "copy/rgb/1.033333.png"}) {
    EXPECT_EQ(ReadFile(Path(name)).substr(1, 3), "PNG") << name;
    EXPECT_EQ(cv::norm(cv::imread(Path(name), cv::IMREAD_UNCHANGED), color, cv::NORM_INF), 0.0);
  }
}

TEST_F(RecordCommandTest, WritesDepthInMetresWithItsOwnScale) {
  Synthesize(1);
  cv::Mat depth(120, 160, CV_32FC1, cv::Scalar(8.0));
  depth.colRange(0, 80).setTo(2.0f);
  cv::imwrite(Path("room/depth/1.tiff"), depth);
  WriteText("room/associations.txt", "1.0 rgb/1.000000.png 1.0 depth/1.tiff\n");
  const CommandOutcome outcome = RunCommand(
      {"record", Path("room"), Path("copy"), "--set", "camera.depth_scale=10000", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const cv::Mat raw = cv::imread(Path("copy/depth/1.000000.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(raw.at<uint16_t>(60, 120), 40000);
  EXPECT_EQ(ReadTextLines(Path("copy/camera.txt")).at(0).fields.at(6), "5000");
}

// The recording with its masks gives the poses of the source with its own.
TEST_F(RecordCommandTest, RecordsMasks) {
  Synthesize(6);
  cv::Mat used = cv::Mat::ones(60, 80, CV_8UC1);  // half the size of the images
  used.colRange(0, 30) = 0;
  ASSERT_TRUE(cv::imwrite(Path("used.png"), used));
  const CommandOutcome outcome =
      RunCommand({"record", Path("room"), Path("copy"), "--mask", Path("used.png"), "--mask-zero"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("--mask " + Path("copy/mask")));
  EXPECT_EQ(NumConsistentPairs(Path("copy")), 6u);
  EXPECT_EQ(ListFolder(Path("copy/mask")).size(), 6u);
  const cv::Mat mask = cv::imread(Path("copy/mask/1.000000.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(mask.size(), cv::Size(160, 120));
  EXPECT_EQ(cv::countNonZero(mask), 60 * 120);
  EXPECT_EQ(cv::countNonZero(mask.colRange(0, 60)), 60 * 120);
  EXPECT_EQ(ReadFile(Path("copy/depth/1.000000.png")), ReadFile(Path("room/depth/1.000000.png")));
  const auto replay = [this](const std::vector<std::string>& arguments, const std::string& output) {
    std::vector<std::string> all = {"replay", "--output", Path(output), "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const CommandOutcome run = RunCommand(all);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return ReadFile(Path(output + "/trajectory.txt"));
  };
  const std::string masked =
      replay({Path("room"), "--mask", Path("used.png"), "--mask-zero"}, "out_room");
  EXPECT_EQ(replay({Path("copy"), "--mask", Path("copy/mask")}, "out_copy"), masked);
  EXPECT_NE(replay({Path("room")}, "out_whole"), masked);
}

TEST_F(RecordCommandTest, RefusesFoldersWithFiles) {
  Synthesize(2);
  WriteText("full/file", "");
  EXPECT_THAT(RunCommand({"record", Path("room"), Path("full")}).output,
              LineNames("error:", Path("full"), "not empty"));
  EXPECT_THAT(RunCommand({"record", Path("room"), Path("room")}).output,
              LineNames("error:", Path("room"), "input"));
}

TEST_F(RecordCommandTest, LeavesOutDamagedImages) {
  Synthesize(4);
  WriteText("room/depth/1.033333.png", "damaged");
  const CommandOutcome outcome =
      RunCommand({"record", Path("room"), Path("copy"), "--max-frames", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(LineNames("2", Path("copy")), LineNames("1", "1.033333.png")));
  EXPECT_EQ(NumConsistentPairs(Path("copy")), 2u);
}

TEST_F(RecordCommandTest, KeepsACompleteFolderOnInterrupt) {
  Synthesize(60, "320");
  CommandProcess record({"record", Path("room"), Path("copy")});
  for (int i = 0; i < 30000 && !HasEntry(Path("copy/depth/1.066667.png")); ++i) usleep(1000);
  record.Signal(SIGINT);
  EXPECT_EQ(record.Wait(), 130) << record.output();
  const size_t count = NumConsistentPairs(Path("copy"));
  EXPECT_GE(count, 2u);
  EXPECT_LT(count, 60u);
}

// A file system of two mebibytes in a namespace of its own.
TEST_F(RecordCommandTest, KeepsACompleteFolderOnAFullDisk) {
  const std::string enter = "unshare --mount --map-root-user sh -c ";
  if (std::system((enter + "'mount -t tmpfs none /mnt' > /dev/null 2>&1").c_str()) != 0) {
    GTEST_SKIP() << "this system lets no test mount a file system";
  }
  Synthesize(40);
  const std::string script = "mount -t tmpfs -o size=1m none /mnt && " MSC_VO_COMMAND " record " +
                             Path("room") + " /mnt/copy > " + Path("log") + " 2>&1; echo $? > " +
                             Path("code") + "; cp -r /mnt/copy " + Path("copy");
  ASSERT_EQ(std::system((enter + "'" + script + "'").c_str()), 0);
  EXPECT_EQ(Trimmed(ReadFile(Path("code"))), "1");
  EXPECT_THAT(ReadFile(Path("log")), Names("error:", "/mnt/copy", "image pairs"));
  const size_t count = NumConsistentPairs(Path("copy"));
  EXPECT_GE(count, 2u);
  EXPECT_LT(count, 40u);
}

TEST_F(RecordCommandTest, SaysWhatABuildLacks) {
  // OpenNI2 does not free all its memory, which AddressSanitizer would report.
  ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  // With or without the libraries, the message names the file.
  WriteText("x.bag", "");
  WriteText("x.oni", "");
  for (const char* name : {"x.bag", "x.oni"}) {
    const CommandOutcome outcome = RunCommand({"record", Path(name), Path("copy")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.output, HasSubstr(Path(name) + ": "));
  }
  EXPECT_THAT(RunCommand({"check", "openni2:"}).output,
              LineNames("error:", "openni2:", "msc_vo record"));
  EXPECT_THAT(RunCommand({"check", Path(""), "--color-topic", "/c"}).output,
              LineNames("error:", "--color-topic", "--depth-topic", ".bag"));
}

}  // namespace
}  // namespace msc_vo
