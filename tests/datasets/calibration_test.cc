// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration.h"

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/config/orb_slam_config.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class CalibrationTest : public TemporaryFolder {
 protected:
  std::string CameraFileError(const std::string& text) {
    WriteText("camera.txt", text);
    return MessageOf([&] { ReadCameraFile(Path("camera.txt")); });
  }
  // A sequence of one image pair, 8 x 6 pixels.
  SequenceIndex Index() {
    WriteDepth("depth.png");
    SequenceIndex index;
    index.directory = Folder();
    index.entries = {{0.0, Path("color.png"), Path("depth.png"), ""}};
    return index;
  }
};

TEST_F(CalibrationTest, ReadsCameraFiles) {
  WriteText("camera.txt", "# fx ...\r\n481.2 -480 319.5 239.5 640 480 5000\r\n");
  Calibration calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.camera.fy, -480.0);
  EXPECT_EQ(calibration.camera.height, 480);
  EXPECT_EQ(calibration.depth_scale, 5000.0);
  EXPECT_TRUE(calibration.distortion.IsZero());
  WriteText("camera.txt", "517 516 318 255 640 480 5000 0.26 -0.95 -0.005 0.002 1.16\n");
  calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.distortion.k[2], -0.005);
  EXPECT_EQ(calibration.distortion.k[4], 1.16);
}

TEST_F(CalibrationTest, CameraFileErrorsNameTheLine) {
  EXPECT_THAT(CameraFileError(""), HasSubstr("camera.txt: is empty"));
  EXPECT_THAT(CameraFileError("#\n1 2 3\n"), HasSubstr("camera.txt:2: expected 7 or 12 numbers"));
  EXPECT_THAT(CameraFileError("a 500 320 240 640 480 5000"), HasSubstr("'a' is not a finite"));
  EXPECT_THAT(CameraFileError("0 500 320 240 640 480 5000"),
              HasSubstr("camera.txt:1: camera: fx = 0 must be"));
  EXPECT_THAT(CameraFileError("500 500 320 240 640 480 0"), HasSubstr("depth_scale"));
}

TEST_F(CalibrationTest, CamerasThatCannotBeAreErrorsOfTheirLine) {
  const std::string fr1 = "517.306408 516.469215 318.643040 255.313989 640 480 5000 ";
  EXPECT_EQ(CameraFileError(fr1 + "0.262383 -0.953104 -0.005358 0.002628 1.163314"), "");
  EXPECT_THAT(CameraFileError(fr1 + "0.262383 -0.953104 1.163314 -0.005358 0.002628"),
              AllOf(HasSubstr("camera.txt:1: camera: the lens"), HasSubstr("folds over"),
                    HasSubstr("k1 k2 p1 p2 k3")));
  EXPECT_THAT(CameraFileError("-535 535 320 240 640 480 5000"), HasSubstr("camera: fx = -535"));
  EXPECT_THAT(CameraFileError("535 535 3200 240 640 480 5000"), HasSubstr("camera: cx = 3200"));
  EXPECT_THAT(CameraFileError("535 535 320 240 1e20 480 5000"), HasSubstr("whole numbers"));
  EXPECT_THAT(CameraFileError("535 535 320 240 640.5 480 5000"), HasSubstr("whole numbers"));
  for (const char* scale : {"-5000", "5", "1e9"}) {
    EXPECT_THAT(CameraFileError(std::string("535 535 320 240 640 480 ") + scale),
                HasSubstr("camera.txt:1: camera: depth_scale = "));
  }
}

TEST_F(CalibrationTest, SettingsThatMakeNoCameraAreErrors) {
  SequenceIndex index = Index();
  index.calibration = FindCameraPreset("tum-fr1").calibration;
  CameraSettings settings;
  settings.origin = "mine.yaml";
  settings.fx = -535.0;
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              AllOf(HasSubstr("mine.yaml"), HasSubstr("fx = -535")));
  settings.fx.reset();
  settings.distortion[4] = 0.0;
  EXPECT_THAT(MessageOf([&] { ResolveCalibration(settings, "", &index); }),
              AllOf(HasSubstr("mine.yaml"), HasSubstr("folds over")));
}

TEST_F(CalibrationTest, KnowsThePublishedCameras) {
  EXPECT_EQ(FindCameraPreset("tum-fr2").calibration.depth_scale, 5208.0);
  EXPECT_EQ(FindCameraPreset("icl-nuim").calibration.camera.fy, -480.0);
  EXPECT_TRUE(FindCameraPreset("tum-fr3").calibration.distortion.IsZero());
  for (const CameraPreset& preset : CameraPresets()) {
    std::string error;
    EXPECT_TRUE(preset.calibration.IsValid(&error)) << preset.name << ": " << error;
  }
  EXPECT_THAT(MessageOf([] { FindCameraPreset("tum-fr9"); }),
              AllOf(HasSubstr("'tum-fr9'"), HasSubstr("tum-fr1, tum-fr2")));
  EXPECT_EQ(GuessCameraPreset("/data/rgbd_dataset_freiburg2_xyz"), "tum-fr2");
  EXPECT_EQ(GuessCameraPreset("/data/fr1_desk"), "tum-fr1");
  EXPECT_EQ(GuessCameraPreset("/data/freiburg1/mine"), "");
  EXPECT_EQ(GuessCameraPreset("/data/fr10_lab"), "");
}

TEST_F(CalibrationTest, SettingsComeBeforeTheFolderAndThatBeforePresets) {
  SequenceIndex index = Index();
  index.preset = "tum-fr1";
  EXPECT_EQ(ResolveCalibration({}, "", &index).camera.fx, 517.306408);
  EXPECT_THAT(ResolveCalibration({}, "", &index).origin, HasSubstr("guessed"));
  EXPECT_EQ(ResolveCalibration({}, "tum-fr3", &index).camera.fx, 535.4);

  index.calibration = FindCameraPreset("replica").calibration;
  EXPECT_EQ(ResolveCalibration({}, "tum-fr3", &index).camera.fx, 600.0);
  EXPECT_THAT(index.warnings, testing::ElementsAre(HasSubstr("tum-fr3 is not used")));

  CameraSettings settings;
  settings.origin = "mine.yaml";
  settings.depth_scale = 1234.0;  // one number over the rest
  const Calibration calibration = ResolveCalibration(settings, "", &index);
  EXPECT_EQ(calibration.depth_scale, 1234.0);
  EXPECT_EQ(calibration.camera.fx, 600.0);
  EXPECT_THAT(calibration.origin, HasSubstr("mine.yaml"));
  settings.preset = "tum-fr2";
  EXPECT_EQ(ResolveCalibration(settings, "", &index).camera.fx, 520.908620);
}

TEST_F(CalibrationTest, FolderNameSaysNothingAboutTheShutter) {
  SequenceIndex index = Index();
  index.directory = "/data/fr2_desk";
  index.calibration = FindCameraPreset("tum-fr3").calibration;
  EXPECT_FALSE(ResolveCalibration({}, "", &index).readout_time.has_value());

  index.calibration.reset();
  index.preset = "tum-fr2";  // guessed: its lens must do, its shutter need not
  const Calibration guess = ResolveCalibration({}, "", &index);
  EXPECT_EQ(guess.camera.fx, 520.908620);
  EXPECT_FALSE(guess.readout_time.has_value());
  EXPECT_EQ(guess.readout_origin, Calibration::kReadoutLearnt);
}

TEST_F(CalibrationTest, PresetNamedByTheUserTellsTheReadoutTime) {
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
  EXPECT_EQ(named.readout_origin, Calibration::kReadoutLearnt);
}

TEST_F(CalibrationTest, CameraFileMayTellTheReadoutTime) {
  const std::string camera = "500 500 320 240 640 480 5000\n";
  WriteText("camera.txt", camera + "# rolling shutter\nreadout_time 0.026\n");
  SequenceIndex index = Index();
  index.directory = "/data/fr1_desk";
  index.calibration = ReadCameraFile(Path("camera.txt"));
  const Calibration calibration = ResolveCalibration({}, "", &index);
  EXPECT_EQ(calibration.readout_time, 0.026);
  EXPECT_EQ(calibration.readout_origin, Path("camera.txt"));
  WriteText("camera.txt", camera);
  EXPECT_FALSE(ReadCameraFile(Path("camera.txt")).readout_time.has_value());

  EXPECT_THAT(CameraFileError(camera + "readout 0.026\n"),
              AllOf(HasSubstr("camera.txt:2: "), HasSubstr("'readout_time SECONDS'")));
  EXPECT_THAT(CameraFileError(camera + "readout_time fast\n"), HasSubstr("camera.txt:2: "));
  EXPECT_THAT(CameraFileError(camera + "readout_time 26\n"),
              AllOf(HasSubstr("camera.txt:2: "), HasSubstr("less than 1")));
  EXPECT_THAT(CameraFileError(camera + "readout_time 0\n\nreadout_time 1\n"),
              HasSubstr("camera.txt:4: "));
}

TEST_F(CalibrationTest, CompleteSettingsLetNothingShineThrough) {
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
}

TEST_F(CalibrationTest, AnUnknownCameraIsAnErrorThatSaysWhatToDo) {
  SequenceIndex index = Index();
  EXPECT_THAT(MessageOf([&] { ResolveCalibration({}, "", &index); }),
              AllOf(HasSubstr("camera.txt"), HasSubstr("--config"), HasSubstr("--camera"),
                    HasSubstr("tum-fr1")));
}

TEST_F(CalibrationTest, ReadsOrbSlamSettingsDespiteTheirBrokenLines) {
  WriteText("orb.yaml",
            "%YAML:1.0\n\n# Camera\nCamera.fx: 517.3  # pixels\nCamera.fy: 516.4\n"
            "Camera.cx: 318.6\nCamera.cy: 255.3\nCamera.k1: 0.26\nCamera.p2: 0.002\n"
            "Camera.bf: 40.0\nDepthMapFactor: 5208.0\nViewer.PointSize:2\n: :\n\"x\n");
  const CameraSettings camera = ReadOrbSlamConfig(Path("orb.yaml"));
  EXPECT_EQ(*camera.fx, 517.3);
  EXPECT_EQ(*camera.depth_scale, 5208.0);
  EXPECT_EQ(*camera.distortion[0], 0.26);
  EXPECT_EQ(*camera.distortion[3], 0.002);
  EXPECT_FALSE(camera.distortion[4].has_value());
  EXPECT_FALSE(camera.width.has_value());
}

TEST_F(CalibrationTest, ReadsOrbSlam3Settings) {
  WriteText("orb3.yaml",
            "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera1.fx: 600\nCamera1.fy: 601\n"
            "Camera1.cx: 320\nCamera1.cy: 240\nCamera.width: 640\nCamera.height: 480\n"
            "RGBD.DepthMapFactor: 1000.0\n");
  const CameraSettings camera = ReadOrbSlamConfig(Path("orb3.yaml"));
  EXPECT_EQ(*camera.fy, 601.0);
  EXPECT_EQ(*camera.width, 640);
  EXPECT_EQ(*camera.depth_scale, 1000.0);
}

TEST_F(CalibrationTest, OtherCameraModelsOfOrbSlamAreErrors) {
  const std::string camera =
      "Camera1.fx: 600\nCamera1.fy: 601\nCamera1.cx: 320\nCamera1.cy: 240\n"
      "RGBD.DepthMapFactor: 1000.0\nCamera1.k1: -0.03\n";
  const auto error_of = [&](const std::string& text) {
    WriteText("orb3.yaml", text + camera);
    return MessageOf([&] { ReadOrbSlamConfig(Path("orb3.yaml")); });
  };
  EXPECT_THAT(error_of("%YAML:1.0\nCamera.type: \"KannalaBrandt8\"\n"),
              AllOf(HasSubstr("orb3.yaml:2: Camera.type \"KannalaBrandt8\" is not supported"),
                    HasSubstr("PinHole and Rectified")));
  EXPECT_THAT(error_of("Camera1.k4: 0.01\n"), HasSubstr("orb3.yaml:1: Camera1.k4: msc_vo knows"));
  EXPECT_THAT(error_of("Camera.k6: 0.01\n"), HasSubstr("Camera.k6"));
  EXPECT_THAT(error_of("Camera.width: 640.5\n"), HasSubstr("Camera.width must be a whole number"));
  EXPECT_EQ(error_of("Camera.k4: 0.0\n"), "");
  EXPECT_EQ(error_of("Camera.type: Pinhole\n"), "");
  EXPECT_EQ(*ReadOrbSlamConfig(Path("orb3.yaml")).distortion[0], -0.03);
  EXPECT_EQ(error_of("Camera.type: \"Rectified\"\n"), "");  // its images are undistorted
  EXPECT_FALSE(ReadOrbSlamConfig(Path("orb3.yaml")).distortion[0].has_value());
}

TEST_F(CalibrationTest, OrbSlamErrorsNameWhatIsMissing) {
  WriteText("orb.yaml", "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\n");
  EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
              HasSubstr("orb.yaml: DepthMapFactor is missing"));
  WriteText("orb.yaml", "\nCamera.fx: wide\n");
  EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
              HasSubstr("orb.yaml:2: Camera.fx must be a number, not 'wide'"));
}

}  // namespace
}  // namespace msc_vo
