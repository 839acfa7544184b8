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
    bag->Write("/camera/rgb/camera_info", "CameraInfo", 1.0, CameraInfoMessage(info));
  }
  void ExpectSameTrajectory(const std::string& a, const std::string& b) {
    EXPECT_EQ(ReadFile(Path(a + "/trajectory.txt")), ReadFile(Path(b + "/trajectory.txt")));
  }
};

// As the TUM benchmark distributes its sequences: depth in metres; the JPEG images as they are.
TEST_F(BagCommandTest, ReplaysTheSampleSequence) {
  const std::string room = MSC_VO_DATA_FOLDER "/room";
  const RgbdDecoder decoder = Decoder(room);
  {
    BagWriter bag(Path("room.bag"), BagCompression::kLz4);
    WriteCamera(decoder.calibration(), &bag);
    for (int i = 0; i < decoder.size(); ++i) {
      const SequenceEntry& entry = decoder.index().entries[i];
      const auto seconds = static_cast<uint32_t>(entry.timestamp);
      const uint32_t nanoseconds = Nanoseconds(entry.timestamp);
      bag.Write("/camera/rgb/image_color/compressed", "CompressedImage", entry.timestamp,
                CompressedMessage(seconds, nanoseconds, "bgr8; jpeg compressed bgr8",
                                  ReadFile(entry.color_path, kMaxImageBytes)));
      bag.Write("/camera/depth/image", "Image", entry.timestamp,
                ImageMessage(seconds, nanoseconds, decoder.Decode(i).depth, "32FC1"));
    }
  }
  std::filesystem::copy_file(room + "/groundtruth.txt", Path("room-groundtruth.txt"));
  Run({"replay", room, "--output", Path("from_folder"), "--quiet"});
  Run({"replay", Path("room.bag"), "--output", Path("from_bag"), "--quiet"});
  ExpectSameTrajectory("from_folder", "from_bag");
  const auto summary = [&](const std::string& run) {
    return nlohmann::json::parse(ReadFile(Path(run + "/summary.json")));
  };
  EXPECT_EQ(summary("from_folder")["error"], summary("from_bag")["error"]);
}

// Raw images, through check and record.
TEST_F(BagCommandTest, RecordsRawImages) {
  Run({"synthesize", Path("folder"), "--frames", "10", "--width", "160"});
  const RgbdDecoder decoder = Decoder(Path("folder"));
  {
    BagWriter bag(Path("raw.bag"), BagCompression::kNone);
    WriteCamera(decoder.calibration(), &bag);
    for (int i = 0; i < decoder.size(); ++i) {
      const SequenceEntry& entry = decoder.index().entries[i];
      const auto seconds = static_cast<uint32_t>(entry.timestamp);
      const uint32_t nanoseconds = Nanoseconds(entry.timestamp);
      bag.Write("/c/image", "Image", entry.timestamp,
                ImageMessage(seconds, nanoseconds, cv::imread(entry.color_path), "bgr8"));
      bag.Write("/d/image", "Image", entry.timestamp,
                ImageMessage(seconds, nanoseconds,
                             cv::imread(entry.depth_path, cv::IMREAD_UNCHANGED), "16UC1"));
    }
  }
  const std::vector<std::string> camera = {"--config", Path("camera.yaml")};
  const PinholeCamera& c = decoder.calibration().camera;
  WriteText("camera.yaml",
            "camera:\n  fx: " + std::to_string(c.fx) + "\n  fy: " + std::to_string(c.fy) +
                "\n  cx: " + std::to_string(c.cx) + "\n  cy: " + std::to_string(c.cy) +
                "\n  width: 160\n  height: 120\n  depth_scale: 5000\n");
  Run({"check", Path("raw.bag"), "--config", Path("camera.yaml")});
  Run({"record", Path("raw.bag"), Path("copy"), "--config", Path("camera.yaml")});
  Run({"replay", Path("folder"), "--output", Path("a"), "--quiet"});
  Run({"replay", Path("raw.bag"), "--output", Path("b"), "--config", Path("camera.yaml"),
       "--quiet"});
  Run({"replay", Path("copy"), "--output", Path("c"), "--quiet"});
  ExpectSameTrajectory("a", "b");
  ExpectSameTrajectory("a", "c");
}

}  // namespace
}  // namespace msc_vo
