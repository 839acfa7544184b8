// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence_calibration.h"

#include <cmath>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/camera_preset.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

class SequenceCalibrationTest : public TemporaryFolder {
 protected:
  // A sequence of one image pair, 8 x 6 pixels.
  SequenceIndex Index() {
    WriteDepth("depth.png");
    SequenceIndex index;
    index.directory = Folder();
    index.entries = {{0.0, Path("color.png"), Path("depth.png"), ""}};
    return index;
  }
};

TEST_F(SequenceCalibrationTest, RejectsInvalidSettings) {
  SequenceIndex index = Index();
  index.calibration = FindCameraPreset("tum-fr1").calibration;
  CameraSettings settings;
  settings.origin = "mine.yaml";
  settings.fx = -535.0;
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              Names("mine.yaml", "fx", "-535"));
  settings.fx.reset();
  settings.lens.coefficients[4] = 0.0;
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              Names("mine.yaml", "fold"));
}

TEST_F(SequenceCalibrationTest, AppliesLens) {
  SequenceIndex index = Index();
  index.calibration = FindCameraPreset("tum-fr3").calibration;
  CameraSettings settings;
  settings.origin = "mine.yaml";
  settings.lens.model = "fisheye";
  const auto error = [&] { return MessageOf([&] { ResolveCalibration(settings, "", &index); }); };
  settings.lens.coefficients = {0.02, -0.01, {}, {}, 0.003, {}, {}, {}};  // k1 k2 k3
  EXPECT_THAT(error(), Names("mine.yaml", "camera.k4", "missing", "fisheye"));
  settings.lens.coefficients[5] = -0.001;
  settings.lens.coefficients[2] = 0.1;  // p1
  EXPECT_THAT(error(), Names("mine.yaml", "camera.p1", "fisheye", "camera.lens"));
  settings.lens.coefficients[2].reset();
  Calibration calibration = ResolveCalibration(settings, "", &index);
  EXPECT_EQ(calibration.distortion.model, LensModel::kFisheye);
  EXPECT_EQ(calibration.distortion.k[3], -0.001);
  EXPECT_EQ(calibration.Recorded().fx, 535.4);
  EXPECT_NE(calibration.camera.fx, 535.4);

  // Single values over a file with a lens.
  index.calibration = calibration;
  CameraSettings more;
  more.origin = "more.yaml";
  more.fx = 500.0;
  more.field_of_view = 60.0;
  more.lens.coefficients[4] = 0.004;
  calibration = ResolveCalibration(more, "", &index);
  EXPECT_EQ(calibration.Recorded().fx, 500.0);
  EXPECT_EQ(calibration.distortion.k[2], 0.004);
  EXPECT_NEAR(calibration.camera.fx, 319.5 / std::tan(M_PI / 6.0), 1e-9);

  settings.lens.model = "wide";
  EXPECT_THAT(error(), Names("mine.yaml", "camera.lens", "'wide'", "radial-tangential"));
  settings.lens = {};
  settings.lens.coefficients[5] = 0.1;  // k4 without a model that has it
  index.calibration = FindCameraPreset("tum-fr3").calibration;
  EXPECT_THAT(error(), Names("mine.yaml", "camera.k4", "camera.lens"));
}

TEST_F(SequenceCalibrationTest, PrefersSettingsThenFolderThenPresets) {
  SequenceIndex index = Index();
  index.preset = "tum-fr1";
  EXPECT_EQ(ResolveCalibration({}, "", &index).camera.fx, 517.306408);
  EXPECT_THAT(ResolveCalibration({}, "", &index).origin, HasSubstr("guessed"));
  EXPECT_EQ(ResolveCalibration({}, "tum-fr3", &index).camera.fx, 535.4);

  index.calibration = FindCameraPreset("replica").calibration;
  EXPECT_EQ(ResolveCalibration({}, "tum-fr3", &index).camera.fx, 600.0);
  EXPECT_THAT(index.warnings, testing::Contains(Names("tum-fr3")));

  CameraSettings settings;
  settings.origin = "mine.yaml";
  settings.depth_scale = 1234.0;  // overrides one value
  const Calibration calibration = ResolveCalibration(settings, "", &index);
  EXPECT_EQ(calibration.depth_scale, 1234.0);
  EXPECT_EQ(calibration.camera.fx, 600.0);
  EXPECT_THAT(calibration.origin, HasSubstr("mine.yaml"));
  settings.preset = "tum-fr2";
  EXPECT_EQ(ResolveCalibration(settings, "", &index).camera.fx, 520.908620);
}

TEST_F(SequenceCalibrationTest, GuessedPresetHasNoReadoutTime) {
  SequenceIndex index = Index();
  index.directory = "/data/fr2_desk";
  index.calibration = FindCameraPreset("tum-fr3").calibration;
  EXPECT_FALSE(ResolveCalibration({}, "", &index).readout_time.has_value());

  index.calibration.reset();
  index.preset = "tum-fr2";  // guessed from the name of the folder
  const Calibration guess = ResolveCalibration({}, "", &index);
  EXPECT_EQ(guess.camera.fx, 520.908620);
  EXPECT_FALSE(guess.readout_time.has_value());
  EXPECT_EQ(guess.readout_origin, Calibration::kSelfCalibrated);
}

TEST_F(SequenceCalibrationTest, NamedPresetHasReadoutTime) {
  SequenceIndex index = Index();
  Calibration named = ResolveCalibration({}, "tum-fr1", &index);
  EXPECT_EQ(named.readout_time, 0.026);
  EXPECT_EQ(named.readout_origin, "preset tum-fr1");
  CameraSettings settings;
  settings.preset = "tum-fr2";
  EXPECT_EQ(ResolveCalibration(settings, "", &index).readout_time, 0.026);
  settings.preset = "tum-fr3";
  named = ResolveCalibration(settings, "", &index);
  EXPECT_FALSE(named.readout_time.has_value());
  EXPECT_EQ(named.readout_origin, Calibration::kSelfCalibrated);
}

TEST_F(SequenceCalibrationTest, CompleteSettingsAreTheOnlySource) {
  SequenceIndex index = Index();
  index.calibration = FindCameraPreset("tum-fr1").calibration;
  CameraSettings settings;
  settings.fx = settings.fy = 10.0;
  settings.cx = settings.cy = 3.0;
  settings.depth_scale = 1000.0;
  const Calibration calibration = ResolveCalibration(settings, "", &index);
  EXPECT_TRUE(calibration.distortion.IsZero());
  EXPECT_EQ(calibration.camera.width, 8);  // from the depth image
  EXPECT_EQ(calibration.camera.height, 6);
  CameraSettings scaled = settings;
  scaled.depth_scale = 0.001;  // metres per unit
  scaled.origin = "options.yaml";
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(scaled, "", &index); }),
              Names("options.yaml", "depth_scale", "0.001", "1000"));
  settings.width = 0;  // not the same as not given
  settings.origin = "--set";
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              Names("--set", "camera.width", "0"));
}

TEST_F(SequenceCalibrationTest, ErrorListsAlternativesAndReasons) {
  SequenceIndex index = Index();
  index.warnings = {"/camera_info gives no calibration"};
  EXPECT_THAT(
      MessageOf([&] { ResolveCalibration({}, "", &index); }),
      Names("camera.txt", "--config", "--camera", "tum-fr1", "/camera_info gives no calibration"));
}

TEST_F(SequenceCalibrationTest, AGuessIsVisibleUnlessTheFolderIsIdentified) {
  const auto warnings = [&](const std::string& directory) {
    SequenceIndex index = Index();
    index.preset = "tum-fr1";
    index.directory = directory;
    ResolveCalibration({}, "", &index);
    return index.warnings;
  };
  EXPECT_THAT(warnings("/data/fr1_lab"), testing::ElementsAre(Names("tum-fr1", "guess")));
  EXPECT_THAT(warnings("/data/rgbd_dataset_freiburg1_xyz"), testing::IsEmpty());
}

TEST_F(SequenceCalibrationTest, DoesNotGuessBesideACalibrationThatItCannotRead) {
  SequenceIndex index = Index();
  index.directory = Folder();
  index.preset = "7-scenes";
  WriteText("calibration.yaml", "focal: 500\n");
  EXPECT_THAT(MessageOf([&] { ResolveCalibration({}, "", &index); }), Names("calibration.yaml"));
}

TEST_F(SequenceCalibrationTest, ErrorGivesTheLineOfTheCameraFile) {
  SequenceIndex index = Index();
  index.directory = Folder();
  WriteText("intrinsic.json",
            R"({"width": 8, "height": 6, "intrinsic_matrix": [7, 0, 0, 0, 6, 0, 4, 2.5, 1]})");
  EXPECT_THAT(MessageOf([&] { ResolveCalibration({}, "", &index); }),
              testing::HasSubstr("7 6 4 2.5 8 6 DEPTH_SCALE"));
  CameraSettings settings;
  settings.fx = settings.fy = settings.cx = settings.cy = 3.0;
  settings.origin = "own.yaml";
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              LineNames("own.yaml", "camera.depth_scale"));
}

// Other programs write depth first, too.
TEST_F(SequenceCalibrationTest, WarnsOfAGuessThatMirrorsTheWorld) {
  WriteText("associations.txt", "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n");
  WriteColor("rgb/0.png", 640, 480);
  WriteDepth("depth/0.png", 5000, 640, 480);
  const auto warnings = [&] {
    SequenceIndex index = OpenSequence(Folder());
    EXPECT_EQ(ResolveCalibration({}, "", &index).camera.fy, -480.0);
    return index.warnings;
  };
  EXPECT_THAT(warnings(), testing::Contains(Names("icl-nuim", "mirrored", "camera.txt")));
  WriteText("office.gt.freiburg", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  EXPECT_THAT(warnings(), testing::Not(testing::Contains(Names("mirrored"))));
}

TEST_F(SequenceCalibrationTest, KeepsReadoutTimeOfFolder) {
  SequenceIndex index = Index();
  index.directory = "/data/fr1_desk";
  index.calibration = FindCameraPreset("tum-fr3").calibration;
  index.calibration->readout_time = 0.02;
  EXPECT_EQ(ResolveCalibration({}, "", &index).readout_time, 0.02);
}

TEST(DepthCameraSettings, CompleteOrChangeOtherSources) {
  SequenceIndex index;
  CameraSettings settings;
  settings.preset = "7-scenes-unregistered";
  settings.origin = "--set";
  settings.depth_camera.translation = {0.02, 0.0, 0.0};
  const Calibration calibration = ResolveCalibration(settings, "", &index);
  ASSERT_TRUE(calibration.depth_camera.has_value());
  EXPECT_EQ(calibration.depth_camera->camera.fx, 585.0);
  EXPECT_EQ(calibration.depth_camera->depth_from_color.translation().x(), 0.02);
  settings.depth_camera.rotation = {0.0, 0.0, 0.0, 2.0};
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              Names("--set", "camera.depth_camera.rotation", "quaternion"));
  settings.depth_camera.rotation.clear();
  settings.preset = "tum-fr3";
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              Names("--set", "camera.depth_camera", "fx", "fy", "cx", "cy"));
}

}  // namespace
}  // namespace msc_vo
