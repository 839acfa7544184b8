// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The command on a bag gives the same bytes as on the folder that the bag was made from.

#include <cmath>

#include "tests/apps/command_process.h"
#include "tests/ros_bag/bag_writer.h"
#include "tests/ros_bag/message_bytes.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

class BagCommandTest : public TemporaryFolder {
 protected:
  void Run(const std::vector<std::string>& arguments) {
    const CommandOutcome outcome = RunCommand(arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  static RgbdDecoder Decoder(const std::string& folder) {
    SequenceIndex index = OpenSequence(folder);
    Calibration calibration = ResolveCalibration({}, "", &index);
    return {std::move(index), std::move(calibration)};
  }
  static uint32_t Nanoseconds(double stamp) {
    return static_cast<uint32_t>(std::llround(1e6 * (stamp - std::floor(stamp)))) * 1000;
  }
  static void WriteCamera(const Calibration& calibration, BagWriter* bag) {
    const PinholeCamera& camera = calibration.camera;
    CameraInfoFields info;
    info.width = static_cast<uint32_t>(camera.width);
    info.height = static_cast<uint32_t>(camera.height);
    info.fx = camera.fx;
    info.fy = camera.fy;
    info.cx = camera.cx;
    info.cy = camera.cy;
    bag->Write("/camera/rgb/camera_info", "sensor_msgs/CameraInfo", 1.0,
               CameraInfoMessage(info, bag->serialization()));
  }
  // As the TUM benchmark distributes its sequences: depth in metres; the JPEG images as they are.
  static void WriteCompressed(const RgbdDecoder& decoder, std::unique_ptr<BagWriter> bag) {
    WriteCamera(decoder.calibration(), bag.get());
    for (int i = 0; i < decoder.size(); ++i) {
      const SequenceEntry& entry = decoder.index().entries[i];
      const auto seconds = static_cast<uint32_t>(entry.timestamp);
      const uint32_t nanoseconds = Nanoseconds(entry.timestamp);
      bag->Write(
          "/camera/rgb/image_color/compressed", "sensor_msgs/CompressedImage", entry.timestamp,
          CompressedMessage(seconds, nanoseconds, "bgr8; jpeg compressed bgr8",
                            ReadFile(entry.color_path, kMaxImageBytes), bag->serialization()));
      bag->Write("/camera/depth/image", "sensor_msgs/Image", entry.timestamp,
                 ImageMessage(seconds, nanoseconds, decoder.Decode(i).depth, "32FC1",
                              bag->serialization()));
    }
  }
  static void WriteRaw(const RgbdDecoder& decoder, std::unique_ptr<BagWriter> bag) {
    for (int i = 0; i < decoder.size(); ++i) {
      const SequenceEntry& entry = decoder.index().entries[i];
      const auto seconds = static_cast<uint32_t>(entry.timestamp);
      const uint32_t nanoseconds = Nanoseconds(entry.timestamp);
      bag->Write("/c/image", "sensor_msgs/Image", entry.timestamp,
                 ImageMessage(seconds, nanoseconds, cv::imread(entry.color_path), "bgr8",
                              bag->serialization()));
      bag->Write(
          "/d/image", "sensor_msgs/Image", entry.timestamp,
          ImageMessage(seconds, nanoseconds, cv::imread(entry.depth_path, cv::IMREAD_UNCHANGED),
                       "16UC1", bag->serialization()));
    }
  }
  void ExpectSameTrajectory(const std::string& a, const std::string& b) {
    EXPECT_EQ(ReadFile(Path(a + "/trajectory.txt")), ReadFile(Path(b + "/trajectory.txt")));
  }
};

TEST_F(BagCommandTest, ReplaysTheSampleSequence) {
  const std::string room = MSC_VO_DATA_FOLDER "/room";
  const RgbdDecoder decoder = Decoder(room);
  WriteCompressed(decoder, WriteRos1Bag(Path("room.bag"), "lz4"));
  WriteCompressed(decoder, WriteDb3Bag(Path("room.db3"), "zstd"));
  WriteCompressed(decoder, WriteMcapBag(Path("room.mcap"), {"zstd", true, true}));
  std::filesystem::copy_file(room + "/groundtruth.txt", Path("room-groundtruth.txt"));
  Run({"replay", room, "--output", Path("folder"), "--quiet"});
  const auto error = [&](const std::string& run) {
    return nlohmann::json::parse(ReadFile(Path(run + "/summary.json")))["error"];
  };
  for (const std::string kind : {"bag", "db3", "mcap"}) {
    SCOPED_TRACE(kind);
    Run({"replay", Path("room." + kind), "--output", Path(kind), "--quiet"});
    ExpectSameTrajectory("folder", kind);
    EXPECT_EQ(error("folder"), error(kind));
  }
}

// Raw images in each kind of bag and compression, through check and record, too.
TEST_F(BagCommandTest, ReplaysRawImages) {
  Run({"synthesize", Path("folder"), "--frames", "10", "--width", "160"});
  const RgbdDecoder decoder = Decoder(Path("folder"));
  const PinholeCamera& c = decoder.calibration().camera;
  WriteText("camera.yaml",
            "camera:\n  fx: " + std::to_string(c.fx) + "\n  fy: " + std::to_string(c.fy) +
                "\n  cx: " + std::to_string(c.cx) + "\n  cy: " + std::to_string(c.cy) +
                "\n  width: 160\n  height: 120\n  depth_scale: 5000\n");
  Run({"replay", Path("folder"), "--output", Path("a"), "--quiet"});
  std::vector<std::string> bags;
  const auto write = [&](std::unique_ptr<BagWriter> bag, const std::string& name) {
    WriteRaw(decoder, std::move(bag));
    bags.push_back(name);
  };
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    write(WriteRos1Bag(Path(compression + ".bag"), compression), compression + ".bag");
  }
  for (const std::string compression : {"none", "zstd"}) {
    write(WriteDb3Bag(Path(compression + ".db3"), compression), compression + ".db3");
  }
  for (const std::string compression : {"", "zstd", "lz4"}) {
    const std::string name = "chunks" + compression + ".mcap";
    write(WriteMcapBag(Path(name), {compression, true, true}), name);
  }
  CompressFile(Path("none.db3"), Path("file.db3.zstd"));
  bags.push_back("file.db3.zstd");
  for (const std::string& bag : bags) {
    SCOPED_TRACE(bag);
    Run({"replay", Path(bag), "--output", Path(bag + "-run"), "--config", Path("camera.yaml"),
         "--quiet"});
    ExpectSameTrajectory("a", bag + "-run");
  }
  Run({"check", Path("none.db3"), "--config", Path("camera.yaml")});
  Run({"record", Path("none.db3"), Path("copy"), "--config", Path("camera.yaml")});
  Run({"replay", Path("copy"), "--output", Path("c"), "--quiet"});
  ExpectSameTrajectory("a", "c");
}

}  // namespace
}  // namespace msc_vo
