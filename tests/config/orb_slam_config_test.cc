// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/orb_slam_config.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class OrbSlamConfigTest : public TemporaryFolder {};

TEST_F(OrbSlamConfigTest, ReadsOrbSlam2SettingsWithMalformedLines) {
  WriteText("orb.yaml",
            "%YAML:1.0\n\n# Camera\nCamera.fx: 517.3  # pixels\nCamera.fy: 516.4\n"
            "Camera.cx: 318.6\nCamera.cy: 255.3\nCamera.k1: 0.26\nCamera.p2: 0.002\n"
            "Camera.bf: 40.0\nDepthMapFactor: 5208.0\nViewer.PointSize:2\n: :\n\"x\n");
  const CameraSettings camera = ReadOrbSlamConfig(Path("orb.yaml"));
  EXPECT_EQ(*camera.fx, 517.3);
  EXPECT_EQ(*camera.depth_scale, 5208.0);
  EXPECT_EQ(*camera.lens.coefficients[0], 0.26);
  EXPECT_EQ(*camera.lens.coefficients[3], 0.002);
  EXPECT_FALSE(camera.lens.coefficients[4].has_value());
  EXPECT_FALSE(camera.width.has_value());
}

TEST_F(OrbSlamConfigTest, ReadsOrbSlam3Settings) {
  WriteText("orb3.yaml",
            "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera1.fx: 600\nCamera1.fy: 601\n"
            "Camera1.cx: 320\nCamera1.cy: 240\nCamera.width: 640\nCamera.height: 480\n"
            "RGBD.DepthMapFactor: 1000.0\n");
  const CameraSettings camera = ReadOrbSlamConfig(Path("orb3.yaml"));
  EXPECT_EQ(*camera.fy, 601.0);
  EXPECT_EQ(*camera.width, 640);
  EXPECT_EQ(*camera.depth_scale, 1000.0);
}

TEST_F(OrbSlamConfigTest, RejectsFactorsThatAreNoUnitsPerMetre) {
  for (const char* name : {"DepthMapFactor", "RGBD.DepthMapFactor", "depthmap_factor"}) {
    WriteText("orb.yaml",
              "%YAML:1.0\nCamera.fx: 600\nCamera.fy: 601\nCamera.cx: 320\nCamera.cy: 240\n" +
                  std::string(name) + ": 0.0002\n");
    EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
                Names("orb.yaml:6", name, "depth_scale", "0.0002", "5000"));
  }
}

TEST_F(OrbSlamConfigTest, RejectsOtherCameraModels) {
  const std::string camera =
      "Camera1.fx: 600\nCamera1.fy: 601\nCamera1.cx: 320\nCamera1.cy: 240\n"
      "RGBD.DepthMapFactor: 1000.0\nCamera1.k1: -0.03\n";
  const auto error_of = [&](const std::string& text) {
    WriteText("orb3.yaml", text + camera);
    return MessageOf([&] { ReadOrbSlamConfig(Path("orb3.yaml")); });
  };
  EXPECT_THAT(error_of("%YAML:1.0\nCamera.type: \"Omnidirectional\"\n"),
              Names("orb3.yaml:2", "Camera.type", "Omnidirectional", "PinHole", "Rectified",
                    "KannalaBrandt8"));
  EXPECT_THAT(error_of("Camera.type: \"KannalaBrandt8\"\n"),
              Names("orb3.yaml", "Camera.k2", "missing"));
  EXPECT_EQ(error_of("Camera.type: \"KannalaBrandt8\"\nCamera1.k2: 0.01\nCamera1.k3: 0.02\n"
                     "Camera1.k4: 0.03\n"),
            "");
  const LensSettings fisheye = ReadOrbSlamConfig(Path("orb3.yaml")).lens;
  EXPECT_EQ(fisheye.model, "fisheye");
  EXPECT_EQ(*fisheye.coefficients[4], 0.02);  // k3
  EXPECT_EQ(*fisheye.coefficients[5], 0.03);  // k4
  EXPECT_THAT(error_of("Camera1.k4: 0.01\n"), Names("orb3.yaml:1", "Camera1.k4", "k1 k2 p1 p2 k3"));
  EXPECT_THAT(error_of("Camera.k6: 0.01\n"), Names("orb3.yaml:1", "Camera.k6", "k1 k2 p1 p2 k3"));
  EXPECT_THAT(error_of("Camera.width: 640.5\n"),
              Names("orb3.yaml:1", "Camera.width", "whole number", "640.5"));
  EXPECT_THAT(error_of("Camera.cols: 640.5\n"),
              Names("orb3.yaml:1", "Camera.cols", "whole number", "640.5"));
  EXPECT_EQ(error_of("Camera.k4: 0.0\n"), "");
  EXPECT_EQ(error_of("Camera.type: Pinhole\n"), "");
  EXPECT_EQ(*ReadOrbSlamConfig(Path("orb3.yaml")).lens.coefficients[0], -0.03);
  EXPECT_EQ(error_of("Camera.type: \"Rectified\"\n"), "");  // its images have no distortion
  EXPECT_FALSE(ReadOrbSlamConfig(Path("orb3.yaml")).lens.coefficients[0].has_value());
}

TEST_F(OrbSlamConfigTest, ErrorsNameMissingAndInvalidValues) {
  WriteText("orb.yaml", "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\n");
  EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
              Names("orb.yaml", "DepthMapFactor", "missing"));
  WriteText("orb.yaml",
            "Camera.fx: 500\nCamera.fy: 500\nCamera.cx: 320\nCamera.cy: 240\nDepthMapFactor: 1\n");
  EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
              Names("orb.yaml:5", "DepthMapFactor", "1000", "floating-point"));
  for (const std::string value : {"wide", "inf", "nan"}) {
    WriteText("orb.yaml", "\nCamera.fx: " + value + "\n");
    EXPECT_THAT(MessageOf([&] { ReadOrbSlamConfig(Path("orb.yaml")); }),
                Names("orb.yaml:2", "Camera.fx", "'" + value + "'"));
  }
}

}  // namespace
}  // namespace msc_vo
