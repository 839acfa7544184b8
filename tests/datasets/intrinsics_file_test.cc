// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/intrinsics_file.h"

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class IntrinsicsFileTest : public TemporaryFolder {
 protected:
  std::optional<GivenIntrinsics> Read(const std::string& name, const std::string& text) {
    WriteText(name, text);
    return ReadIntrinsicsFile(Path(name));
  }
};

TEST_F(IntrinsicsFileTest, ReadsNumbersMatricesAndJson) {
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"calibration.txt", "500 501 320 240\n"},
           {"k.csv", "500,0,320\n0,501,240\n0,0,1\n"},
           {"k.txt", "500 0 320 0\n0 501 240 0\n0 0 1 0\n"},
           {"k4.txt", "500 0 320 0\n0 501 240 0\n0 0 1 0\n0 0 0 1\n"},
           {"cam_params.json", R"({"camera": {"fx": 500, "fy": 501, "cx": 320, "cy": 240}})"},
           {"intrinsic.json", R"({"intrinsic_matrix": [500, 0, 0, 0, 501, 0, 320, 240, 1]})"},
           {"transforms.json",
            R"({"fl_x": 500, "fl_y": 501, "cx": 320.5, "cy": 240.5, "k1": 0})"}}) {
    const std::optional<GivenIntrinsics> given = Read(name, text);
    ASSERT_TRUE(given.has_value()) << name;
    EXPECT_EQ(given->camera.fx, 500.0);
    EXPECT_EQ(given->camera.fy, 501.0);
    EXPECT_EQ(given->camera.cx, 320.0);
    EXPECT_EQ(given->camera.cy, 240.0);
  }
}

TEST_F(IntrinsicsFileTest, ReadsDepthScalesOfJson) {
  const std::string camera = R"("fx": 500, "fy": 501, "cx": 320, "cy": 240)";
  EXPECT_EQ(Read("a.json", "{" + camera + R"(, "depth_scale": 1000, "scale": 2})")->depth_scale,
            1000.0);
  EXPECT_EQ(Read("b.json", R"({"camera": {)" + camera + R"(, "scale": 6553.5}})")->depth_scale,
            6553.5);
  EXPECT_FALSE(Read("c.json", "{" + camera + R"(, "scale": 1000})")->depth_scale);  // of the scene
}

TEST_F(IntrinsicsFileTest, OtherContentsAreNoCamera) {
  EXPECT_FALSE(Read("pose.txt", "1 0 0 2\n0 1 0 3\n0 0 1 4\n0 0 0 1\n"));
  EXPECT_FALSE(Read("rotation.txt", "0 -1 0\n1 0 0\n0 0 1\n"));
  EXPECT_FALSE(Read("skew.txt", "500 3 320\n0 500 240\n0 0 1\n"));
  EXPECT_FALSE(Read("lens.txt", "500 500 320 240 0.1 0.2 0 0 0\n"));
  EXPECT_FALSE(Read("words.txt", "focal 500\n"));
  EXPECT_FALSE(Read("lens.json", R"({"fl_x": 5, "fl_y": 5, "cx": 3, "cy": 2, "k1": 0.1})"));
  EXPECT_FALSE(Read("broken.json", "{"));
  EXPECT_FALSE(ReadIntrinsicsFile(Path("none.txt")));
}

TEST(FindSizeOf, IsThatOfTheNearestCentre) {
  PinholeCamera camera;
  camera.cx = 639.5;
  camera.cy = 479.5;
  EXPECT_EQ(FindSizeOf(camera, {{640, 480}, {1280, 960}})->width, 1280);
  EXPECT_EQ(FindSizeOf(camera, {{1300, 975}, {1280, 960}})->width, 1280);
  EXPECT_FALSE(FindSizeOf(camera, {{640, 480}}));
  camera.cx = 637.0;  // far from both centres
  camera.cy = 511.0;
  EXPECT_EQ(FindSizeOf(camera, {{1280, 960}, {1296, 968}})->width, 1280);
}

TEST_F(IntrinsicsFileTest, FindsFilesByName) {
  for (const char* name : {"Calibration.txt", "intrinsic.json", "camera_matrix.csv", "rgb.txt",
                           "groundtruth.txt", "calibration.png"}) {
    WriteText(name, "");
  }
  EXPECT_THAT(FindCalibrationFiles(Folder()),
              testing::ElementsAre(Path("Calibration.txt"), Path("camera_matrix.csv"),
                                   Path("intrinsic.json")));
}

}  // namespace
}  // namespace msc_vo
