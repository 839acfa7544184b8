// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Cameras that the files of a layout describe.

#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {
namespace {

using LayoutCameraTest = TemporaryFolder;

TEST_F(LayoutCameraTest, ReadsIntrinsicsOf3DMatch) {
  WriteColor("seq/frame-000000.color.png");
  WriteDepth("seq/frame-000000.depth.png");
  WriteText("camera-intrinsics.txt", "7 0 3.5\n0 5 2.5\n0 0 1\n");
  WriteColor("seq/frame-000001.color.png");
  WriteText("seq/frame-000000.depth.png", "damaged");
  WriteDepth("seq/frame-000001.depth.png");
  const SequenceIndex index = OpenSequence(Path("seq"));
  ASSERT_TRUE(index.calibration.has_value());
  EXPECT_EQ(index.calibration->camera.fy, 5.0);
  EXPECT_EQ(index.calibration->camera.width, 8);
  EXPECT_EQ(index.calibration->depth_scale, 1000.0);
  EXPECT_THAT(index.warnings, testing::IsEmpty());
  // Of larger colour images, and of no images.
  WriteText("camera-intrinsics.txt", "14 0 7.5\n0 14 5.5\n0 0 1\n");
  WriteColor("seq/frame-000000.color.png", 16, 12);
  EXPECT_EQ(OpenSequence(Path("seq")).calibration->camera.width, 16);
  WriteText("seq/camera-intrinsics.txt", "572 0 320\n0 573 240\n0 0 1\n");
  EXPECT_THAT(MessageOf([&] { OpenSequence(Path("seq")); }), Names("camera-intrinsics.txt"));
}

TEST_F(LayoutCameraTest, ReadsTheDepthCameraOf3RScan) {
  WriteColor("frame-000000.color.png", 32, 18);
  WriteDepth("frame-000000.depth.png");
  WriteText("_info.txt",
            "m_colorWidth = 32\nm_colorHeight = 18\nm_depthWidth = 8\nm_depthHeight = 6\n"
            "m_calibrationColorIntrinsic = 30 0 16 0 0 30 9 0 0 0 1 0 0 0 0 1\n"
            "m_calibrationDepthIntrinsic = 7 0 3.5 0 0 7 2.5 0 0 0 1 0 0 0 0 1\n"
            "m_calibrationDepthExtrinsic = 1 0 0 0.02 0 1 0 0 0 0 1 0 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_TRUE(index.calibration && index.calibration->depth_camera);
  EXPECT_EQ(index.calibration->camera.width, 32);
  EXPECT_EQ(index.calibration->depth_camera->camera.fx, 7.0);
  EXPECT_EQ(index.calibration->depth_camera->depth_from_color.translation().x(), 0.02);
}

TEST_F(LayoutCameraTest, ReadsTheCameraOfReplica) {
  WriteColor("seq/results/frame000000.jpg", 12, 8);
  WriteDepth("seq/results/depth000000.png", 5000, 12, 8);
  EXPECT_FALSE(OpenSequence(Path("seq")).calibration.has_value());
  WriteText("cam_params.json",
            R"({"camera": {"w": 12, "h": 8, "fx": 9, "fy": 9, "cx": 6, "cy": 4, "scale": 1000}})");
  const SequenceIndex index = OpenSequence(Path("seq"));
  ASSERT_TRUE(index.calibration.has_value());
  EXPECT_EQ(index.calibration->camera.fx, 9.0);
  EXPECT_EQ(index.calibration->depth_scale, 1000.0);
  EXPECT_THAT(index.warnings, testing::IsEmpty());
}

TEST_F(LayoutCameraTest, IntrinsicsOfScanNetMayBeThoseOfItsPublishedSize) {
  WriteColor("color/0.png", 160, 120);
  WriteDepth("depth/0.png", 1000, 160, 120);
  WriteText("intrinsic/intrinsic_color.txt", "1164 0 647.5\n0 1164 483.5\n0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_TRUE(index.calibration.has_value());
  EXPECT_NEAR(index.calibration->camera.fx, 1164.0 * 160 / 1296, 1e-9);
  EXPECT_THAT(index.warnings, testing::ElementsAre(Names("intrinsic_color.txt", "1296x968")));
}

TEST_F(LayoutCameraTest, ReadsInfoBesideImagesLikeThoseOfSevenScenes) {
  WriteText("data/frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  WriteColor("data/frame-000000.color.png", 16, 12);
  WriteDepth("data/frame-000000.depth.png");
  const std::string size = "m_colorWidth = 32\nm_colorHeight = 24\nm_depthShift = 5000\n";
  const std::string camera = "20 0 15.5 0 0 22 11.5 0 0 0 1 0 0 0 0 1";
  WriteText("info.txt", size + "m_sensorName = StructureSensor\n");
  EXPECT_FALSE(OpenSequence(Path("data")).calibration.has_value());
  for (const char* name : {"info.txt", "data/_info.txt"}) {
    WriteText(name, size + "m_calibrationColorIntrinsic = " + camera + " \n");
    const SequenceIndex index = OpenSequence(Path("data"));
    ASSERT_TRUE(index.calibration.has_value());
    EXPECT_EQ(index.calibration->depth_scale, 5000.0);
    EXPECT_TRUE(index.scale_color);
    // Of 32 x 24 pixels, for depth of 8 x 6.
    EXPECT_EQ(index.calibration->camera.fx, 5.0);
    EXPECT_EQ(index.calibration->camera.fy, 5.5);
    EXPECT_EQ(index.calibration->camera.cx, 3.5);
    std::filesystem::remove(Path(name));
  }
  WriteText("info.txt", size + "m_calibrationColorIntrinsic = 20 x\n");
  EXPECT_THAT(MessageOf([&] { OpenSequence(Path("data")); }), Names("info.txt:4"));
}

}  // namespace
}  // namespace msc_vo
