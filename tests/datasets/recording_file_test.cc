// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/recording_file.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

class RecordingFileTest : public TemporaryFolder {
 protected:
  std::string ErrorOf(const std::string& name) {
    return MessageOf([&] { OpenSequence(Path(name)); });
  }
};

TEST_F(RecordingFileTest, EndingsTellKindsOfFiles) {
  for (const auto& [name, what] :
       {std::pair("a.db3", "ROS 2"), std::pair("a.MCAP", "ROS 2"), std::pair("a.mp4", "video"),
        std::pair("a.svo", "ZED"), std::pair("a.klg", "Kintinuous"), std::pair("a.sens", "ScanNet"),
        std::pair("a.tar.gz", "archive"), std::pair("a.npz", "arrays"),
        std::pair("a.oni", "OpenNI2")}) {
    WriteText(name, "contents");
    EXPECT_THAT(ErrorOf(name), Names(Path(name), what));
    EXPECT_TRUE(IsSequenceFile(Path(name))) << name;
  }
}

TEST_F(RecordingFileTest, ContentsTellKindsOfFilesWithAnyName) {
  const std::string tail(600, 'x');
  for (const auto& [bytes, what] : {std::pair(std::string("SQLite format 3\0", 16), "SQLite"),
                                    std::pair(std::string("\x89MCAP0\r\n"), "MCAP"),
                                    std::pair(std::string("PK\x03\x04"), "zip"),
                                    std::pair(std::string("\0\0\0\x20"
                                                          "ftypisom",
                                                          12),
                                              "video"),
                                    std::pair(std::string("RIFF....AVI LIST"), "video"),
                                    std::pair(std::string("\x1a\x45\xdf\xa3"), "Azure Kinect"),
                                    std::pair(std::string("\x1f\x8b\x08"), "gzip"),
                                    std::pair(std::string(257, '\0') + "ustar", "tar"),
                                    std::pair(std::string("#ROSBAG V2.0\n"), "msc_vo record")}) {
    WriteText("recording", bytes + tail);
    EXPECT_THAT(ErrorOf("recording"), Names(Path("recording"), what));
  }
}

TEST_F(RecordingFileTest, NamesTheRecordingInAFolder) {
  WriteText("bag/metadata.yaml", "rosbag2_bagfile_information:\n");
  WriteText("bag/bag_0.db3", "");
  EXPECT_THAT(ErrorOf("bag"), Names("RGB-D sequence", Path("bag/bag_0.db3"), "ROS 2"));
  WriteColor("images/a.png");
  EXPECT_THAT(ErrorOf("images"), Not(HasSubstr("a.png")));
}

TEST_F(RecordingFileTest, OtherFilesNeedTheirFolder) {
  WriteText("rgb.txt", "1.0 rgb/1.png\n");
  EXPECT_EQ(DescribeFile(Path("rgb.txt")), "");
  EXPECT_THAT(ErrorOf("rgb.txt"), Names("rgb.txt", "folder"));
  WriteColor("a.png");
  EXPECT_THAT(ErrorOf("a.png"), Names("a.png", "image", "folder"));
  EXPECT_FALSE(IsSequenceFile(Path("a.png")));
  EXPECT_EQ(DescribeFile(Path("nowhere.db3")), "");
}

}  // namespace
}  // namespace msc_vo
