// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_preset.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(CameraPresets, AreValidPublishedCalibrations) {
  EXPECT_EQ(FindCameraPreset("tum-fr2").calibration.depth_scale, 5208.0);
  EXPECT_EQ(FindCameraPreset("icl-nuim").calibration.camera.fy, -480.0);
  EXPECT_TRUE(FindCameraPreset("tum-fr3").calibration.distortion.IsZero());
  for (const CameraPreset& preset : CameraPresets()) {
    std::string error;
    EXPECT_TRUE(preset.calibration.IsValid(&error)) << preset.name << ": " << error;
  }
}

TEST(FindCameraPreset, ErrorListsKnownNames) {
  EXPECT_THAT(MessageOf([] { FindCameraPreset("tum-fr9"); }),
              Names("'tum-fr9'", "tum-fr1", "tum-fr2"));
}

TEST(GuessCameraPreset, RecognisesTumFolders) {
  EXPECT_EQ(GuessCameraPreset("/data/rgbd_dataset_freiburg2_xyz"), "tum-fr2");
  EXPECT_EQ(GuessCameraPreset("/data/fr1_desk"), "tum-fr1");
  EXPECT_EQ(GuessCameraPreset("/data/freiburg1/mine"), "");
  EXPECT_EQ(GuessCameraPreset("/data/fr1desk"), "tum-fr1");
  EXPECT_EQ(GuessCameraPreset("/data/fr10_lab"), "");
  EXPECT_EQ(GuessCameraPreset("/data/fr3nch_flat"), "");
  EXPECT_EQ(GuessCameraPreset("/data/uni_freiburg2_lab"), "");
}

TEST(HasPublishedName, RecognisesSequencesOfDataSets) {
  EXPECT_TRUE(HasPublishedName("/data/rgbd_dataset_freiburg2_xyz/"));
  EXPECT_TRUE(HasPublishedName("/data/chess/seq-01"));
  EXPECT_FALSE(HasPublishedName("/data/fr2_xyz"));
  EXPECT_FALSE(HasPublishedName("/data/garage/seq-01"));
}

TEST(GuessCameraPreset, RecognisesTheFolderBehindADot) {
  EXPECT_EQ(GuessCameraPreset("/data/fr1_desk/."), "tum-fr1");
  EXPECT_EQ(GuessCameraPreset("/data/fr1_desk/"), "tum-fr1");
  EXPECT_EQ(GuessCameraPreset("/data/fr1_desk/rgb/.."), "tum-fr1");
  const std::filesystem::path before = std::filesystem::current_path();
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "msc_vo_rgbd_dataset_freiburg1_rpy";
  std::filesystem::create_directories(folder);
  std::filesystem::current_path(folder);
  EXPECT_EQ(GuessCameraPreset("."), "tum-fr1");
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace msc_vo
