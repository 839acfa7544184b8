// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The orientation that a photograph asks to be displayed with (EXIF) rotates no image: the camera
// is calibrated with the rows and columns of the sensor.

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

// Inserts an APP1 segment after the begin of a JPEG file: TIFF, big-endian, one entry, tag 0x112.
std::string WithOrientation(const std::string& jpeg, char orientation) {
  std::string segment(
      "\xFF\xE1\0\x22"
      "Exif\0\0"
      "MM\0\x2A\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0\0\0\0"
      "\0\0\0\0",
      36);
  segment[29] = orientation;
  return jpeg.substr(0, 2) + segment + jpeg.substr(2);
}

class ImageOrientationTest : public TemporaryFolder {
 protected:
  // The same sequence twice: "plain", and "turned", whose images ask to be rotated.
  void SetUp() override {
    TemporaryFolder::SetUp();
    for (const std::string folder : {"plain", "turned"}) {
      RenderSequence(Path(folder), {"--frames", "8", "--width", "160", "--jpeg"});
    }
    for (const std::string& path : ListFolder(Path("turned/rgb"))) {
      const std::string jpeg = WithOrientation(ReadFile(path), 6);  // by 90 degrees
      const std::vector<char> bytes(jpeg.begin(), jpeg.end());
      ASSERT_EQ(cv::imdecode(bytes, cv::IMREAD_COLOR).size(), cv::Size(120, 160));
      WriteFile(path, jpeg);
    }
  }
  void Run(const std::vector<std::string>& arguments) const {
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  void ExpectSame(const std::string& plain, const std::string& turned) const {
    EXPECT_FALSE(ReadFile(Path(plain)).empty());
    EXPECT_TRUE(ReadFile(Path(plain)) == ReadFile(Path(turned))) << plain;
  }
  void Replay() const {
    for (const std::string folder : {"plain", "turned"}) {
      Run({"replay", Path(folder), "--output", Path("out_" + folder), "--quiet"});
    }
  }
};

TEST_F(ImageOrientationTest, CountsNeitherInReplayNorInRecord) {
  Replay();
  ExpectSame("out_plain/trajectory.txt", "out_turned/trajectory.txt");
  Run({"record", Path("turned"), Path("copy")});
  EXPECT_EQ(ReadFile(Path("copy/rgb/1.000000.jpg")), ReadFile(Path("turned/rgb/1.000000.jpg")));
  // Images that are reduced are encoded again.
  for (const std::string folder : {"plain", "turned"}) {
    Run({"record", Path(folder), Path("small_" + folder), "--set", "camera.max_width=80"});
  }
  ExpectSame("small_plain/rgb/1.000000.png", "small_turned/rgb/1.000000.png");
}

#ifdef MSC_VO_HAS_FUSION
TEST_F(ImageOrientationTest, CountsNotInSurfaces) {
  Replay();
  for (const std::string folder : {"plain", "turned"}) {
    Run({"fuse", Path(folder), Path("out_" + folder + "/trajectory.txt"), "--voxel", "0.05",
         "--output", Path(folder + ".ply")});
    Run({"export", Path("out_" + folder), "ply", Path(folder + "_points.ply"), "--voxel", "0.05"});
  }
  ExpectSame("plain.ply", "turned.ply");
  ExpectSame("plain_points.ply", "turned_points.ply");
}
#endif

}  // namespace
}  // namespace msc_vo
