// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The camera files in data/cameras.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsSupersetOf;

const fs::path kDataFolder = MSC_VO_DATA_FOLDER;

std::set<std::string> CameraFileNames() {
  std::set<std::string> names;
  for (const fs::directory_entry& file : fs::directory_iterator(kDataFolder / "cameras")) {
    names.insert(file.path().filename().string());
  }
  return names;
}

std::string PathOf(const std::string& name) { return (kDataFolder / "cameras" / name).string(); }

// Returns the calibration of a run with --config FILE.
Calibration Load(const std::string& name) {
  Configuration configuration;
  ReadConfiguration(PathOf(name), &configuration);
  SequenceIndex no_images;
  Calibration calibration = ResolveCalibration(configuration.camera, "", &no_images);
  calibration.readout_time = configuration.odometry.mapping.readout_time;
  return calibration;
}

TEST(CameraFilesTest, AreCompleteCalibrations) {
  const std::set<std::string> names = CameraFileNames();
  EXPECT_GE(names.size(), 11u);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    Calibration calibration;
    ASSERT_EQ(MessageOf([&] { calibration = Load(name); }), "");
    std::string error;
    EXPECT_TRUE(calibration.IsValid(&error)) << error;
    // The principal point is near the image centre, within a tenth of the image size.
    const PinholeCamera& camera = calibration.camera;
    EXPECT_NEAR(camera.cx / camera.width, 0.5, 0.1);
    EXPECT_NEAR(camera.cy / camera.height, 0.5, 0.1);
    EXPECT_NEAR(std::abs(camera.fy / camera.fx), 1.0, 0.01);
  }
}

TEST(CameraFilesTest, AgreeWithPresets) {
  std::set<std::string> expected;
  for (const CameraPreset& preset : CameraPresets()) expected.insert(preset.name + ".yaml");
  ASSERT_THAT(CameraFileNames(), IsSupersetOf(expected));
  for (const CameraPreset& preset : CameraPresets()) {
    SCOPED_TRACE(preset.name);
    const Calibration file = Load(preset.name + ".yaml");
    const PinholeCamera &a = file.camera, &b = preset.calibration.camera;
    EXPECT_EQ(a.fx, b.fx);
    EXPECT_EQ(a.fy, b.fy);
    EXPECT_EQ(a.cx, b.cx);
    EXPECT_EQ(a.cy, b.cy);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_THAT(file.distortion.k, ElementsAreArray(preset.calibration.distortion.k));
    EXPECT_EQ(file.depth_scale, preset.calibration.depth_scale);
    EXPECT_EQ(file.readout_time, preset.calibration.readout_time);
    ASSERT_EQ(file.depth_camera.has_value(), preset.calibration.depth_camera.has_value());
    if (!file.depth_camera) continue;
    EXPECT_EQ(file.depth_camera->camera.fx, preset.calibration.depth_camera->camera.fx);
    EXPECT_EQ(file.depth_camera->camera.cx, preset.calibration.depth_camera->camera.cx);
    EXPECT_EQ(file.depth_camera->camera.width, preset.calibration.depth_camera->camera.width);
    EXPECT_EQ(file.depth_camera->depth_from_color.params,
              preset.calibration.depth_camera->depth_from_color.params);
  }
}

TEST(CameraFilesTest, AreListedAndMarkedNominalIfGeneric) {
  const std::string readme = ReadFile((kDataFolder / "README.md").string());
  for (const std::string& name : CameraFileNames()) {
    EXPECT_THAT(readme, HasSubstr("(cameras/" + name + ")"));
    const std::string stem = name.substr(0, name.find(".yaml"));
    const bool is_built_in =
        std::any_of(CameraPresets().begin(), CameraPresets().end(),
                    [&](const CameraPreset& preset) { return preset.name == stem; });
    if (!is_built_in) {
      EXPECT_THAT(ReadFile(PathOf(name)), Names("Nominal")) << name;
    }
  }
}

}  // namespace
}  // namespace msc_vo
