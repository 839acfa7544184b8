// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/camera_options.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/camera_file.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

// With all values that a file can give, of many digits.
Calibration FullCalibration() {
  Calibration calibration;
  calibration.SetRecorded({500.0 / 3.0, 167.0, 158.1234567891, 119.5, 320, 240});
  calibration.distortion.model = LensModel::kFisheye;
  calibration.distortion.k = {0.02, -0.012, 0.006, -0.0015};
  calibration.depth_scale = 1000.0;
  calibration.depth_sensor = DepthSensor::kLidar;
  calibration.field_of_view = 80.0;
  calibration.readout_time = 0.026;
  DepthCamera depth_camera;
  depth_camera.camera = {200.0, 201.0, 150.0, 110.0, 300, 220};
  depth_camera.depth_from_color =
      Rigid3(Eigen::Quaterniond(0.8, 0.6, 0.0, 0.0), Eigen::Vector3d(0.025, 1.0 / 3.0, 0.0));
  depth_camera.inverse_depth_offset = 0.004;
  depth_camera.distortion.k = {0.1, -0.2, 0.001, -0.002, 0.3};
  calibration.depth_camera = depth_camera;
  calibration.SetUndistorted();
  return calibration;
}

class CameraOptionsTest : public TemporaryFolder {
 protected:
  Configuration Read(const std::string& text, Configuration configuration = {}) {
    WriteText("camera", text);
    ReadCamera(Path("camera"), &configuration);
    return configuration;
  }
  static std::string Text(const Configuration& configuration) {
    return FormatChangedOptions(configuration, "title");
  }
};

TEST_F(CameraOptionsTest, ReadsWhatIsWritten) {
  const Configuration written = CameraConfiguration(FullCalibration());
  const std::string text = Text(written);
  EXPECT_THAT(text, HasSubstr("camera:\n  fx: 166.66666666666666\n"));
  EXPECT_THAT(text, HasSubstr("\n  depth_camera:\n    fx: 200\n"));
  EXPECT_THAT(text, HasSubstr("\nmapping:\n  readout_time: 0.026\n"));
  EXPECT_THAT(text, HasSubstr("\nfeatures:\n  depth_sensor: lidar\n"));
  EXPECT_EQ(Text(Read(text)), text);
}

TEST_F(CameraOptionsTest, ReadsTheLinesOfACameraFile) {
  const Calibration calibration = FullCalibration();
  WriteText("camera.txt", "# a comment\n\n" + FormatCameraFile(calibration, "camera"));
  Configuration configuration;
  ReadCamera(Path("camera.txt"), &configuration);
  EXPECT_EQ(Text(configuration), Text(CameraConfiguration(calibration)));
  EXPECT_EQ(configuration.camera.origin, Path("camera.txt"));
}

TEST_F(CameraOptionsTest, ReplacesTheCameraAndNothingElse) {
  Configuration before;
  before.camera.lens.coefficients[0] = 0.1;
  before.odometry.mode = Mode::kPlVo;
  before.odometry.mapping.readout_time = 0.01;
  before.odometry.features.depth_sensor = DepthSensor::kStereo;
  const Configuration configuration = Read("mode: pl-vo-depth\ncamera: {fx: 300}\n", before);
  EXPECT_EQ(configuration.camera.fx, 300.0);
  EXPECT_FALSE(configuration.camera.lens.coefficients[0].has_value());
  EXPECT_EQ(configuration.odometry.mode, Mode::kPlVo);
  EXPECT_EQ(configuration.odometry.mapping.readout_time, 0.01);
  EXPECT_EQ(configuration.odometry.features.depth_sensor, DepthSensor::kStereo);
}

TEST_F(CameraOptionsTest, RefusesAFileWithoutACamera) {
  EXPECT_THAT(MessageOf([&] { Read("mode: pl-vo\n"); }), Names(Path("camera"), "no camera"));
  EXPECT_THAT(MessageOf([&] { Read("500 500 320 240\n"); }),
              Names(Path("camera:1"), "7", "12", "4"));
}

TEST_F(CameraOptionsTest, RefusesCalibrationsOfOtherPrograms) {
  Configuration configuration;
  WriteText("ros.yaml", "image_width: 640\ncamera_matrix:\n  rows: 3\n  cols: 3\n");
  WriteText("open3d.json", "{\"width\": 640,\n \"intrinsic_matrix\": [525, 0, 0]}\n");
  EXPECT_THAT(MessageOf([&] { ReadCamera(Path("ros.yaml"), &configuration); }),
              Names("ros.yaml:2", "camera_matrix", "camera.txt", "fx fy cx cy"));
  EXPECT_THAT(MessageOf([&] { ReadCamera(Path("open3d.json"), &configuration); }),
              Names("open3d.json:2", "intrinsic_matrix", "camera.txt"));
}

TEST_F(CameraOptionsTest, NamesTheValueThatDiffers) {
  const Calibration calibration = FullCalibration();
  EXPECT_EQ(DescribeDifference(calibration, calibration), "");
  Calibration other = calibration;
  other.readout_time.reset();
  EXPECT_THAT(DescribeDifference(calibration, other), Names("mapping.readout_time", "0.026"));
  other = calibration;
  other.depth_camera->camera.cx += 1e-8;
  EXPECT_THAT(DescribeDifference(other, calibration),
              Names("camera.depth_camera.cx", "150.00000001", "150"));
}

}  // namespace
}  // namespace msc_vo
