// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_file.h"

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/tum_writer.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
  EXPECT_THAT(ErrorOf(""), HasSubstr("camera.txt: is empty"));
  EXPECT_THAT(ErrorOf("#\n1 2 3\n"), HasSubstr("camera.txt:2: expected 7 or 12 numbers"));
  EXPECT_THAT(ErrorOf("a 500 320 240 640 480 5000"), HasSubstr("'a' is not a finite"));
  EXPECT_THAT(ErrorOf("0 500 320 240 640 480 5000"),
              HasSubstr("camera.txt:1: camera: fx = 0 must be"));
  EXPECT_THAT(ErrorOf("500 500 320 240 640 480 0"), HasSubstr("depth_scale"));
}

TEST_F(CameraFileTest, RejectsImpossibleCameras) {
  const std::string fr1 = "517.306408 516.469215 318.643040 255.313989 640 480 5000 ";
  EXPECT_EQ(ErrorOf(fr1 + "0.262383 -0.953104 -0.005358 0.002628 1.163314"), "");
  EXPECT_THAT(ErrorOf(fr1 + "0.262383 -0.953104 1.163314 -0.005358 0.002628"),
              AllOf(HasSubstr("camera.txt:1: camera: the lens"), HasSubstr("folds over"),
                    HasSubstr("k1 k2 p1 p2 k3")));
  EXPECT_THAT(ErrorOf("-535 535 320 240 640 480 5000"), HasSubstr("camera: fx = -535"));
  EXPECT_THAT(ErrorOf("535 535 3200 240 640 480 5000"), HasSubstr("camera: cx = 3200"));
  EXPECT_THAT(ErrorOf("535 535 320 240 1e20 480 5000"), HasSubstr("whole numbers"));
  EXPECT_THAT(ErrorOf("535 535 320 240 640.5 480 5000"), HasSubstr("whole numbers"));
  for (const char* scale : {"-5000", "5", "1e9"}) {
    EXPECT_THAT(ErrorOf(std::string("535 535 320 240 640 480 ") + scale),
                HasSubstr("camera.txt:1: camera: depth_scale = "));
  }
}

TEST_F(CameraFileTest, NamesTheReciprocalOfMetresPerUnit) {
  const std::string camera = "535 535 320 240 640 480 ";
  EXPECT_THAT(ErrorOf(camera + "0.001"),
              AllOf(HasSubstr("camera.txt:1: camera: depth_scale = 0.001"),
                    HasSubstr("1000 units per metre")));
  EXPECT_THAT(ErrorOf(camera + "0.00025"), HasSubstr("4000 units per metre"));
  EXPECT_THAT(ErrorOf(camera + "1"), HasSubstr("1000 units per metre if depth is in millimetres"));
}

TEST(DepthScale, DecoderAndWriterRefuseMetresPerUnit) {
  Calibration calibration;
  calibration.depth_scale = 0.001;
  EXPECT_THAT(MessageOf([&] { RgbdDecoder(SequenceIndex(), calibration); }),
              HasSubstr("1000 units per metre"));
  const std::string folder = testing::TempDir() + "/not_written";
  EXPECT_THAT(MessageOf([&] { TumWriter(folder, calibration, ""); }),
              HasSubstr("1000 units per metre"));
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

  EXPECT_THAT(ErrorOf(camera + "readout 0.026\n"),
              AllOf(HasSubstr("camera.txt:2: "), HasSubstr("'readout_time SECONDS'")));
  EXPECT_THAT(ErrorOf(camera + "readout_time fast\n"), HasSubstr("camera.txt:2: "));
  EXPECT_THAT(
      ErrorOf(camera + "readout_time 26\n"),
      AllOf(HasSubstr("camera.txt:2: "), HasSubstr("readout_time = 26 must be between -1 and 1")));
  EXPECT_THAT(ErrorOf(camera + "readout_time 0\n\nreadout_time 1\n"), HasSubstr("camera.txt:4: "));
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
              AllOf(HasSubstr("camera.txt:2: expected 9 or 13 numbers"), HasSubstr("[qx qy qz qw]"),
                    HasSubstr("found 6")));
  EXPECT_THAT(ErrorOf(camera + "depth_camera 585 585 320 240 640 480 -25 0 0\n"),
              HasSubstr("camera.txt:2: depth camera: translation is 25 long"));
  EXPECT_THAT(ErrorOf(camera + "depth_camera 0 585 320 240 640 480 0 0 0\n"),
              HasSubstr("camera.txt:2: depth camera: fx = 0"));
  EXPECT_THAT(ErrorOf(camera + line + " 0 0 0 2\n"), HasSubstr("must have length 1"));
  EXPECT_THAT(ErrorOf(camera + line + " a 0 0 1\n"), HasSubstr("'a' is not a finite"));
  EXPECT_THAT(ErrorOf(camera + line + "\n" + line + "\n"), HasSubstr("camera.txt:3: a second"));
  EXPECT_THAT(ErrorOf(camera + "deph_camera 1\n"), HasSubstr("'depth_camera fx fy"));
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
              HasSubstr("camera.txt:2: unknown lens model 'fish'; known: radial-tangential, "
                        "rational, fisheye"));
  EXPECT_THAT(ErrorOf(camera + "lens fisheye 0 0 0\n"),
              HasSubstr("camera.txt:2: expected the 4 coefficients k1 k2 k3 k4 of the lens model "
                        "fisheye, found 3"));
  EXPECT_THAT(ErrorOf(camera + "lens rational 0 0 0 0 0\n"), HasSubstr("expected the 8"));
  EXPECT_THAT(ErrorOf(camera + "lens fisheye a 0 0 0\n"), HasSubstr("'a' is not a finite"));
  EXPECT_THAT(ErrorOf(camera + "lens\n"), HasSubstr("camera.txt:2: expected a lens"));
  EXPECT_THAT(ErrorOf(camera + "# wide\nlens fisheye -0.4 0 0 0\n"),
              AllOf(HasSubstr("camera.txt:3: camera: the lens k1 k2 k3 k4"),
                    HasSubstr("folds over"), HasSubstr("smaller field_of_view")));
  EXPECT_EQ(ErrorOf(camera + "lens fisheye -0.4 0 0 0\nfield_of_view 60\n"), "");
  EXPECT_THAT(ErrorOf(camera + "field_of_view 170\n"),
              HasSubstr("camera.txt:2: camera: field_of_view = 170 must be from 10 to 150"));
  EXPECT_THAT(ErrorOf(camera + "field_of_view wide\n"), HasSubstr("'field_of_view DEGREES'"));
  const std::string lens = "lens fisheye 0 0 0 0\n";
  EXPECT_THAT(ErrorOf(camera + lens + lens), HasSubstr("camera.txt:3: a second line lens"));
  EXPECT_THAT(ErrorOf("300 301 322 238 640 480 1000 0.1 0 0 0 0\n" + lens),
              HasSubstr("camera.txt:2: the first line gives a lens, too"));
  EXPECT_THAT(ErrorOf(camera + "depth_lens fisheye 0 0 0 0\n"),
              HasSubstr("camera.txt:2: the lens of a depth camera needs the line 'depth_camera"));
}

}  // namespace
}  // namespace msc_vo
