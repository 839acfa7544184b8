// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_file.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/tum_writer.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::Not;

class CameraFileTest : public TemporaryFolder {
 protected:
  std::string ErrorOf(const std::string& text) {
    WriteText("camera.txt", text);
    return MessageOf([&] { ReadCameraFile(Path("camera.txt")); });
  }
};

TEST_F(CameraFileTest, ReadsIntrinsicsAndDistortion) {
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

TEST_F(CameraFileTest, ErrorsNameLine) {
  EXPECT_THAT(ErrorOf(""), Names("camera.txt", "empty"));
  EXPECT_THAT(ErrorOf("#\n1 2 3\n"), Names("camera.txt:2", "7", "12", "3"));
  EXPECT_THAT(ErrorOf("a 500 320 240 640 480 5000"), Names("camera.txt:1", "'a'"));
  EXPECT_THAT(ErrorOf("0 500 320 240 640 480 5000"), Names("camera.txt:1", "fx = 0"));
  EXPECT_THAT(ErrorOf("500 500 320 240 640 480 0"), Names("camera.txt:1", "depth_scale = 0"));
}

TEST_F(CameraFileTest, RejectsImpossibleCameras) {
  const std::string fr1 = "517.306408 516.469215 318.643040 255.313989 640 480 5000 ";
  EXPECT_EQ(ErrorOf(fr1 + "0.262383 -0.953104 -0.005358 0.002628 1.163314"), "");
  EXPECT_THAT(ErrorOf(fr1 + "0.262383 -0.953104 1.163314 -0.005358 0.002628"),
              Names("camera.txt:1", "lens", "fold", "k1 k2 p1 p2 k3"));
  EXPECT_THAT(ErrorOf("-535 535 320 240 640 480 5000"), Names("fx", "-535"));
  EXPECT_THAT(ErrorOf("535 535 3200 240 640 480 5000"), Names("cx", "3200"));
  EXPECT_THAT(ErrorOf("535 535 320 240 1e20 480 5000"), Names("width", "height", "whole"));
  EXPECT_THAT(ErrorOf("535 535 320 240 640.5 480 5000"), Names("width", "height", "whole"));
  for (const char* scale : {"-5000", "5", "1000000000"}) {
    EXPECT_THAT(ErrorOf(std::string("535 535 320 240 640 480 ") + scale),
                Names("camera.txt:1", std::string("depth_scale = ") + scale));
  }
}

TEST_F(CameraFileTest, NamesTheReciprocalOfMetresPerUnit) {
  const std::string camera = "535 535 320 240 640 480 ";
  EXPECT_THAT(ErrorOf(camera + "0.001"), Names("camera.txt:1", "depth_scale", "0.001", "1000"));
  EXPECT_THAT(ErrorOf(camera + "0.00025"), Names("0.00025", "4000"));
  EXPECT_THAT(ErrorOf(camera + "1"), Names("depth_scale = 1", "1000", "millimetres"));
}

TEST(DepthScale, DecoderAndWriterRefuseMetresPerUnit) {
  Calibration calibration;
  calibration.depth_scale = 0.001;
  EXPECT_THAT(MessageOf([&] { RgbdDecoder(SequenceIndex(), calibration); }),
              Names("depth_scale", "1000"));
  const std::string folder = testing::TempDir() + "/not_written";
  EXPECT_THAT(MessageOf([&] { TumWriter(folder, calibration, ""); }), Names("depth_scale", "1000"));
  EXPECT_FALSE(HasEntry(folder));
}

TEST_F(CameraFileTest, ReadsReadoutTime) {
  const std::string camera = "500 500 320 240 640 480 5000\n";
  WriteText("camera.txt", camera + "# rolling shutter\nreadout_time 0.026\n");
  const Calibration calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.readout_time, 0.026);
  EXPECT_EQ(calibration.readout_origin, Path("camera.txt"));
  WriteText("camera.txt", camera);
  EXPECT_FALSE(ReadCameraFile(Path("camera.txt")).readout_time.has_value());

  EXPECT_THAT(ErrorOf(camera + "readout 0.026\n"), Names("camera.txt:2", "readout_time", "lens"));
  EXPECT_THAT(ErrorOf(camera + "readout_time fast\n"), Names("camera.txt:2", "readout_time"));
  EXPECT_THAT(ErrorOf(camera + "readout_time 26\n"),
              Names("camera.txt:2", "readout_time", "26", "-1", "1"));
  EXPECT_THAT(ErrorOf(camera + "readout_time 0\n\nreadout_time 1\n"),
              Names("camera.txt:4", "second", "readout_time"));
}

TEST_F(CameraFileTest, ReadsDepthCamera) {
  const std::string camera = "525 525 320 240 640 480 1000\n";
  WriteText("camera.txt", camera + "depth_camera 585 586 321 241 512 424 -0.025 0.001 0.002\n" +
                              "readout_time 0.026\n");
  Calibration calibration = ReadCameraFile(Path("camera.txt"));
  ASSERT_TRUE(calibration.depth_camera.has_value());
  EXPECT_EQ(calibration.readout_time, 0.026);
  EXPECT_EQ(calibration.depth_camera->camera.fy, 586.0);
  EXPECT_EQ(calibration.depth_camera->camera.height, 424);
  EXPECT_EQ(calibration.depth_camera->depth_from_color.translation(),
            Eigen::Vector3d(-0.025, 0.001, 0.002));
  EXPECT_EQ(calibration.depth_camera->depth_from_color.rotation().w(), 1.0);
  const std::string line = "depth_camera 585 586 321 241 512 424 -0.025 0 0";
  WriteText("camera.txt", camera + line + " 0 0 0.6 0.8\n");
  calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_NEAR(calibration.depth_camera->depth_from_color.rotation().z(), 0.6, 1e-12);

  EXPECT_THAT(ErrorOf(camera + "depth_camera 585 585 320 240 640 480\n"),
              Names("camera.txt:2", "9", "13", "[qx qy qz qw]", "6"));
  EXPECT_THAT(ErrorOf(camera + "depth_camera 585 585 320 240 640 480 -25 0 0\n"),
              Names("camera.txt:2", "depth camera", "translation", "25"));
  EXPECT_THAT(ErrorOf(camera + "depth_camera 0 585 320 240 640 480 0 0 0\n"),
              Names("camera.txt:2", "depth camera", "fx", "0"));
  EXPECT_THAT(ErrorOf(camera + line + " 0 0 0 2\n"), Names("camera.txt:2", "quaternion", "1"));
  EXPECT_THAT(ErrorOf(camera + line + " a 0 0 1\n"), Names("camera.txt:2", "'a'"));
  EXPECT_THAT(ErrorOf(camera + line + "\n" + line + "\n"),
              Names("camera.txt:3", "second", "depth_camera"));
  EXPECT_THAT(ErrorOf(camera + "deph_camera 1\n"),
              Names("camera.txt:2", "depth_camera", "readout_time"));
}

TEST_F(CameraFileTest, ReadsLens) {
  const std::string camera = "300 301 322 238 640 480 1000\n";
  WriteText("camera.txt", camera + "field_of_view 90\nlens fisheye 0.02 -0.012 0.006 -0.0015\n");
  Calibration calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.distortion.model, LensModel::kFisheye);
  EXPECT_EQ(calibration.distortion.k[3], -0.0015);
  EXPECT_EQ(calibration.Recorded().fy, 301.0);
  EXPECT_NEAR(calibration.camera.fx, 319.5, 1e-9);  // 45 degrees to each side
  // What is written is read as the same.
  WriteText("copy.txt", FormatCameraFile(calibration, "copy"));
  const Calibration copy = ReadCameraFile(Path("copy.txt"));
  EXPECT_EQ(copy.camera.fx, calibration.camera.fx);
  EXPECT_EQ(copy.Recorded().cx, 322.0);
  EXPECT_EQ(copy.distortion.k, calibration.distortion.k);

  WriteText("camera.txt", camera + "lens rational 0.1 0.2 0.001 0.002 0.3 0.4 0.5 0.6\n");
  calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.distortion.model, LensModel::kRational);
  EXPECT_EQ(calibration.distortion.k[7], 0.6);
  EXPECT_EQ(calibration.camera.fx, 300.0);  // the undistorted image has the same intrinsics

  WriteText("camera.txt", camera + "depth_lens rational 0.1 0.2 0 0 0.3 0.1 0.2 0.3\n" +
                              "depth_camera 585 585 320 240 640 480 0.03 0 0\n");
  calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.depth_camera->distortion.k[4], 0.3);
  WriteText("copy.txt", FormatCameraFile(calibration, "copy"));
  EXPECT_EQ(ReadCameraFile(Path("copy.txt")).depth_camera->distortion.k,
            calibration.depth_camera->distortion.k);
}

TEST_F(CameraFileTest, KeepsOffsetAndSensorOfDepth) {
  const std::string camera = "525 525 320 240 640 480 1000\n";
  const std::string depth = "depth_camera 585 586 321 241 512 424 -0.025 0.001 0.002\n";
  WriteText("camera.txt", camera + "inverse_depth_offset 0.02\ndepth_sensor lidar\n" + depth);
  Calibration calibration = ReadCameraFile(Path("camera.txt"));
  EXPECT_EQ(calibration.depth_camera->inverse_depth_offset, 0.02);
  EXPECT_EQ(calibration.depth_sensor, DepthSensor::kLidar);
  WriteText("copy.txt", FormatCameraFile(calibration, "copy"));
  calibration = ReadCameraFile(Path("copy.txt"));
  EXPECT_EQ(calibration.depth_camera->inverse_depth_offset, 0.02);
  EXPECT_EQ(calibration.depth_sensor, DepthSensor::kLidar);

  EXPECT_THAT(ErrorOf(camera + "inverse_depth_offset 0.02\n"),
              Names("camera.txt:2", "inverse_depth_offset", "depth_camera"));
  EXPECT_THAT(ErrorOf(camera + depth + "inverse_depth_offset nan\n"),
              Names("camera.txt:3", "inverse_depth_offset", "METRES"));
  EXPECT_THAT(ErrorOf(camera + "depth_sensor auto\n"),
              Names("camera.txt:2", "depth_sensor", "structured-light|tof|stereo|lidar"));
}

TEST_F(CameraFileTest, WritesTheShortestNumbersThatAreReadAsTheSame) {
  Calibration calibration;
  calibration.camera = {525.1, 525.2, 319.3, 239.7, 640, 480};
  calibration.distortion.k = {-0.3, 0.1};
  calibration.readout_time = 0.025;
  calibration.depth_camera = DepthCamera{{585.0, 585.0, 319.5, 239.5, 640, 480}, {}};
  calibration.depth_camera->depth_from_color.translation().x() = 0.025;
  EXPECT_EQ(FormatCameraFile(calibration, "test"),
            "525.1 525.2 319.3 239.7 640 480 5000 -0.3 0.1 0 0 0\n"
            "readout_time 0.025\n"
            "depth_camera 585 585 319.5 239.5 640 480 0.025 0 0 0 0 0 1\n"
            "# fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]\n# test\n");
}

TEST_F(CameraFileTest, RejectsImpossibleLenses) {
  const std::string camera = "300 301 322 238 640 480 1000\n";
  EXPECT_THAT(ErrorOf(camera + "lens fish 0 0 0 0\n"),
              Names("camera.txt:2", "'fish'", "radial-tangential", "rational", "fisheye"));
  EXPECT_THAT(ErrorOf(camera + "lens fisheye 0 0 0\n"),
              Names("camera.txt:2", "fisheye", "4", "k1 k2 k3 k4", "3"));
  EXPECT_THAT(ErrorOf(camera + "lens rational 0 0 0 0 0\n"),
              Names("camera.txt:2", "rational", "8", "5"));
  EXPECT_THAT(ErrorOf(camera + "lens fisheye a 0 0 0\n"), Names("camera.txt:2", "'a'"));
  EXPECT_THAT(ErrorOf(camera + "lens\n"), Names("camera.txt:2", "lens fisheye k1 k2 k3 k4"));
  EXPECT_THAT(ErrorOf(camera + "# wide\nlens fisheye -0.4 0 0 0\n"),
              Names("camera.txt:3", "lens", "fold", "k1 k2 k3 k4", "field_of_view"));
  EXPECT_EQ(ErrorOf(camera + "lens fisheye -0.4 0 0 0\nfield_of_view 60\n"), "");
  EXPECT_THAT(ErrorOf(camera + "field_of_view 170\n"),
              Names("camera.txt:2", "field_of_view", "170", "10", "150"));
  EXPECT_THAT(ErrorOf(camera + "field_of_view wide\n"),
              Names("camera.txt:2", "field_of_view DEGREES"));
  const std::string lens = "lens fisheye 0 0 0 0\n";
  EXPECT_THAT(ErrorOf(camera + lens + lens), Names("camera.txt:3", "second", "lens"));
  EXPECT_THAT(ErrorOf("300 301 322 238 640 480 1000 0.1 0 0 0 0\n" + lens),
              Names("camera.txt:2", "first line", "lens", "k1 k2 p1 p2 k3"));
  EXPECT_THAT(
      ErrorOf(camera + "depth_lens fisheye 0 0 0 0\n"),
      AllOf(Names("camera.txt:2", "depth_lens", "depth_camera"), Not(Names("readout_time"))));
}

}  // namespace
}  // namespace msc_vo
