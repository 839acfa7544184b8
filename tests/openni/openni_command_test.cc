// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The command with a live camera and with a recording of it: a driver plays rendered images.

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "tests/openni/fake_camera_file.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

constexpr int kNumImages = 45;

class OpenNiCommandTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    fs::create_directories(Path("lib/OpenNI2/Drivers"));
    fs::copy_file(MSC_VO_OPENNI2_LIBRARY, Path("lib/libOpenNI2.so.0"));
    fs::copy_file(MSC_VO_FAKE_CAMERA_DRIVER, Path("lib/OpenNI2/Drivers/libFakeCamera.so.0"));
    if (!fs::exists(MSC_VO_OPENNI2_FILE_DRIVER)) GTEST_SKIP() << "OpenNI2 cannot read recordings";
    fs::copy_file(MSC_VO_OPENNI2_FILE_DRIVER, Path("lib/OpenNI2/Drivers/libOniFile.so.0"));
    Run(MSC_VO_COMMAND " synthesize " + Path("room") + " --frames " + std::to_string(kNumImages) +
        " --width 160 --speed 0.2");
    WriteCameraFile();
  }

  // Runs a shell command beside the fake camera; returns its exit code. Its output is in `log`.
  // OpenNI2 and its drivers do not free all their memory, which AddressSanitizer would report.
  int Run(const std::string& command) {
    const std::string environment = "LD_LIBRARY_PATH=" + Path("lib") +
                                    " MSC_VO_FAKE_CAMERA=" + Path("images") +
                                    " LSAN_OPTIONS=detect_leaks=0 timeout 60 ";
    const int status = std::system((environment + command + " > " + Path("log") + " 2>&1").c_str());
    return WEXITSTATUS(status);
  }
  std::string Log() { return ReadFile(Path("log")); }

  void WriteCameraFile() {
    const SequenceIndex index = OpenSequence(Path("room"));
    const PinholeCamera& camera = index.calibration->camera;
    FakeCameraHeader header;
    header.width = camera.width;
    header.height = camera.height;
    header.count = static_cast<int32_t>(index.entries.size());
    header.horizontal_fov = static_cast<float>(2.0 * std::atan(0.5 * camera.width / camera.fx));
    header.vertical_fov = static_cast<float>(2.0 * std::atan(0.5 * camera.height / camera.fy));
    std::ofstream file(Path("images"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof(header));
    for (const SequenceEntry& entry : index.entries) {
      cv::Mat rgb, depth;
      cv::cvtColor(cv::imread(entry.color_path), rgb, cv::COLOR_BGR2RGB);
      cv::imread(entry.depth_path, cv::IMREAD_UNCHANGED).convertTo(depth, CV_16U, 0.2);
      for (const cv::Mat* image : {&rgb, &depth}) {
        file.write(reinterpret_cast<const char*>(image->data),
                   static_cast<std::streamsize>(image->total() * image->elemSize()));
      }
    }
  }

  // Grey value and depth of a pixel of a recorded pair equal those of the rendered pair at
  // `offset`.
  void ExpectSameImages(const std::string& folder, int i, int offset) {
    const SequenceIndex copy = OpenSequence(folder);
    const SequenceIndex room = OpenSequence(Path("room"));
    const SequenceEntry& a = copy.entries.at(i);
    const SequenceEntry& b = room.entries.at(i + offset);
    EXPECT_EQ(cv::norm(cv::imread(a.color_path), cv::imread(b.color_path)), 0.0);
    cv::Mat millimetres;
    cv::imread(b.depth_path, cv::IMREAD_UNCHANGED).convertTo(millimetres, CV_16U, 0.2);
    EXPECT_EQ(cv::norm(cv::imread(a.depth_path, cv::IMREAD_UNCHANGED), millimetres), 0.0);
  }
};

TEST_F(OpenNiCommandTest, RecordsALiveCamera) {
  ASSERT_EQ(Run(MSC_VO_COMMAND " record openni2: " + Path("copy") + " --max-frames 20"), 0)
      << Log();
  const SequenceIndex copy = OpenSequence(Path("copy"));
  ASSERT_EQ(copy.entries.size(), 20u);
  EXPECT_NEAR(copy.entries[0].depth_delay, 0.002, 1e-5);
  EXPECT_NEAR(copy.entries[1].timestamp - copy.entries[0].timestamp, 0.033333, 0.001);
  EXPECT_GT(copy.entries[0].timestamp, 1.6e9);  // a date
  const SequenceIndex room = OpenSequence(Path("room"));
  EXPECT_NEAR(copy.calibration->camera.fx, room.calibration->camera.fx, 1e-3);
  EXPECT_EQ(copy.calibration->depth_scale, 1000.0);
  ExpectSameImages(Path("copy"), 0, 0);
}

TEST_F(OpenNiCommandTest, TracksALiveCamera) {
  ASSERT_EQ(Run(MSC_VO_COMMAND " replay openni2: --output " + Path("out") + " --max-frames 20"), 0)
      << Log();
  const nlohmann::json summary = nlohmann::json::parse(ReadFile(Path("out/summary.json")));
  EXPECT_EQ(summary["frames"]["count"], 20);
  EXPECT_GT(summary["frames"]["tracked_ratio"], 0.9);
  EXPECT_FALSE(summary["realtime"].is_null());
}

TEST_F(OpenNiCommandTest, ReadsARecording) {
  ASSERT_EQ(Run(MSC_VO_ONI_RECORDER " " + Path("x.oni") + " " + std::to_string(kNumImages - 5)), 0)
      << Log();
  ASSERT_EQ(Run(MSC_VO_COMMAND " check " + Path("x.oni")), 0) << Log();
  ASSERT_EQ(Run(MSC_VO_COMMAND " record " + Path("x.oni") + " " + Path("copy")), 0) << Log();
  const SequenceIndex copy = OpenSequence(Path("copy"));
  ASSERT_GE(copy.entries.size(), 35u);
  ExpectSameImages(Path("copy"), 0, 0);
  ExpectSameImages(Path("copy"), 20, 0);
  ASSERT_EQ(Run(MSC_VO_COMMAND " replay " + Path("x.oni") + " --output " + Path("a")), 0) << Log();
  ASSERT_EQ(Run(MSC_VO_COMMAND " replay " + Path("copy") + " --output " + Path("b")), 0) << Log();
  EXPECT_EQ(ReadFile(Path("a/trajectory.txt")), ReadFile(Path("b/trajectory.txt")));
}

TEST_F(OpenNiCommandTest, SaysThatThereIsNoCamera) {
  fs::remove(Path("lib/OpenNI2/Drivers/libFakeCamera.so.0"));
  EXPECT_EQ(Run(MSC_VO_COMMAND " replay openni2: --output " + Path("out")), 1);
  EXPECT_THAT(Log(), Names("openni2:", "camera"));
  WriteText("bad.oni", "this is no recording");
  EXPECT_EQ(Run(MSC_VO_COMMAND " replay " + Path("bad.oni")), 1);
  EXPECT_THAT(Log(), Names("bad.oni", "recording"));
}

}  // namespace
}  // namespace msc_vo
