// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Bags with damaged messages, and files that were cut off.

#include <filesystem>

#include "tests/ros_bag/bag_writer.h"
#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/ros_bag/bag_sequence.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kImage[] = "sensor_msgs/Image";

class BagDamageTest : public TemporaryFolder {
 protected:
  // `count` pairs of images of noise at 30 Hz; `damaged` of the first colour images have no header.
  static void WritePairs(std::unique_ptr<BagWriter> bag, int count, int damaged = 0) {
    for (int i = 0; i < count; ++i) {
      cv::Mat color(24, 32, CV_8UC3), depth(24, 32, CV_16UC1);
      cv::randu(color, 0, 255);
      cv::randu(depth, 1000, 2000);
      const auto nanoseconds = static_cast<uint32_t>(33333333 * i);
      const double recorded = 100.0 + 1e-9 * nanoseconds;
      const RosSerialization form = bag->serialization();
      const std::string message = ImageMessage(100, nanoseconds, color, "bgr8", form);
      bag->Write("/c", kImage, recorded, i < damaged ? message.substr(0, 9) : message);
      bag->Write("/d", kImage, recorded, ImageMessage(100, nanoseconds, depth, "16UC1", form));
    }
  }
  void Cut(const std::string& name, double ratio) {
    const std::string bytes = ReadFile(Path(name));
    WriteText(name, bytes.substr(0, static_cast<size_t>(ratio * bytes.size())));
  }
};

TEST_F(BagDamageTest, LeavesOutDamagedMessages) {
  WritePairs(WriteRos1Bag(Path("x.bag")), 9, 2);
  WritePairs(WriteDb3Bag(Path("x.db3")), 9, 2);
  WritePairs(WriteMcapBag(Path("x.mcap")), 9, 2);
  for (const std::string name : {"x.bag", "x.db3", "x.mcap"}) {
    const SequenceIndex index = OpenBag(Path(name));
    EXPECT_THAT(index.warnings, ElementsAre(Names("2", "9", "colour", name + ":/c, message 0")));
    ASSERT_EQ(index.entries.size(), 7u);
    EXPECT_EQ(index.entries[0].color_index, 2);
    EXPECT_EQ(index.entries[0].depth_index, 2);
  }
}

TEST_F(BagDamageTest, RejectsBagsWithMostlyDamagedMessages) {
  WritePairs(WriteDb3Bag(Path("most.db3")), 9, 5);
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("most.db3")); }),
              Names("5", "9", "most.db3:/c, message 0"));
  WritePairs(WriteDb3Bag(Path("all.db3")), 9, 9);
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("all.db3")); }),
              Names("all.db3", "no topic", "all.db3:/c, message 8"));
}

// Pixels that do not fit the header are found when their frame is decoded.
TEST_F(BagDamageTest, FindsTheUnitOfDepthBesideADamagedFirstImage) {
  const cv::Mat depth(24, 32, CV_32FC1, cv::Scalar(1.5)), color(24, 32, CV_8UC3);
  auto bag = WriteRos1Bag(Path("x.bag"));
  for (const uint32_t i : {1, 2, 3}) {
    bag->Write("/c", kImage, i, ImageMessage(i, 0, color, "bgr8"));
    const cv::Mat pixels = i == 1 ? color : depth;  // less than 32FC1 needs
    bag->Write("/d", kImage, i, ImageMessage(i, 0, pixels, "32FC1"));
  }
  bag.reset();
  const SequenceIndex index = OpenBag(Path("x.bag"));
  EXPECT_EQ(index.entries.size(), 3u);
  EXPECT_EQ(index.depth_scale, 5000.0);
}

TEST_F(BagDamageTest, ReadsDatabasesUpToTheirCut) {
  WritePairs(WriteDb3Bag(Path("x.db3")), 40);
  Cut("x.db3", 0.5);
  const SequenceIndex index = OpenBag(Path("x.db3"));
  EXPECT_GE(index.entries.size(), 17u);
  EXPECT_LE(index.entries.size(), 20u);
  ASSERT_THAT(index.warnings, testing::Not(IsEmpty()));
  EXPECT_THAT(index.warnings.front(), Names("x.db3", "malformed", ".recover"));
  for (const SequenceEntry& entry : index.entries) {
    EXPECT_EQ(index.container->ReadColor(entry.color_index).pixels.rows, 24);
    EXPECT_EQ(index.container->ReadDepth(entry.depth_index).pixels.rows, 24);
  }
  for (const double ratio : {0.9, 0.5, 0.1, 0.01}) {
    Cut("x.db3", ratio);
    EXPECT_THAT(MessageOf([&] { OpenBag(Path("x.db3")); }), testing::AnyOf("", Names("x.db3")));
  }
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("x.db3")); }), Names("x.db3", ".recover"));
}

TEST_F(BagDamageTest, NamesTheRepairOfBagsOfRos1) {
  WritePairs(WriteRos1Bag(Path("x.bag")), 9);
  for (const double ratio : {0.995, 0.5}) {
    Cut("x.bag", ratio);
    EXPECT_THAT(MessageOf([&] { OpenBag(Path("x.bag")); }), Names("x.bag", "rosbag reindex"));
  }
}

TEST_F(BagDamageTest, ReadsTheOtherChunks) {
  for (const bool has_index : {false, true}) {
    const std::string name = has_index ? "indexed.mcap" : "unindexed.mcap";
    WritePairs(WriteMcapBag(Path(name), {"zstd", true, has_index}), 9);
    std::string bytes = ReadFile(Path(name));
    const size_t frame = bytes.find("\x28\xb5\x2f\xfd", bytes.size() / 2);
    ASSERT_NE(frame, std::string::npos);
    WriteText(name, bytes.replace(frame + 4, 8, "\xff\xff\xff\xff\xff\xff\xff\xff"));
    const SequenceIndex index = OpenBag(Path(name));  // three messages are lost
    EXPECT_GE(index.entries.size(), 7u);
    EXPECT_LE(index.entries.size(), 8u);
    ASSERT_THAT(index.warnings, testing::Not(IsEmpty()));
    EXPECT_THAT(index.warnings.front(), Names(name, "1 of 6 chunks", "mcap recover"));
  }
}

TEST_F(BagDamageTest, LeavesOutEmptyFilesOfAFolder) {
  std::filesystem::create_directory(Path("walk"));
  WritePairs(WriteDb3Bag(Path("walk/walk_0.db3")), 9);
  WriteText("walk/walk_1.db3", "");
  const SequenceIndex index = OpenBag(Path("walk"));
  EXPECT_EQ(index.entries.size(), 9u);
  EXPECT_THAT(index.warnings, ElementsAre(Names("walk/walk_1.db3", "empty")));
}

TEST_F(BagDamageTest, DescribesFilesThatAreOnlyNamedAsBags) {
  WriteText("empty.mcap", "");
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("empty.mcap")); }), Names("empty.mcap", "is empty"));
  WriteText("zero.mcap", std::string(1000, '\0'));
  EXPECT_THAT(MessageOf([&] { OpenBag(Path("zero.mcap")); }), Names("zero.mcap", "is no bag"));
}

}  // namespace
}  // namespace msc_vo
