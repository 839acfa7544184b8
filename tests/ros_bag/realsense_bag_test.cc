// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Bags as the RealSense viewer records them: of ROS 1, and since 2025 SQLite files with bare pixels
// and values as text. Topics and texts as its library writes them.

#include "tests/ros_bag/bag_writer.h"
#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/bag_sequence.h"

namespace msc_vo {
namespace {

using testing::IsEmpty;

constexpr char kDepth[] = "/device_0/sensor_0/Depth_0";
constexpr char kColor[] = "/device_0/sensor_1/Color_0";
constexpr char kInfrared[] = "/device_0/sensor_0/Infrared_1";

class RealSenseBagTest : public TemporaryFolder {
 protected:
  // Three images of 32x24 pixels, depth of 16x12 with 2000 units of 0.25 mm. The colour camera is
  // turned by 90 degrees about z and lies 15 mm beside the depth camera.
  void WriteOldBag(const std::string& path, bool has_transforms = true) {
    const auto bag = WriteRos1Bag(path);
    const auto write_camera = [&](const std::string& stream, uint32_t width, double fx,
                                  const std::vector<double>& d, const std::string& model) {
      CameraInfoFields info{width, width * 3 / 4, fx, fx, width / 2.0, width * 3 / 8.0, model, d};
      bag->Write(stream + "/info/camera_info", "sensor_msgs/CameraInfo", 1.0,
                 CameraInfoMessage(info));
    };
    write_camera(kDepth, 16, 20.0, {0, 0, 0, 0, 0}, "Brown Conrady");
    write_camera(kColor, 32, 30.0, {0.1, 0, 0, 0, 0}, "Inverse Brown Conrady");
    bag->Write("/device_0/sensor_0/option/Depth_Units/value", "std_msgs/Float32", 1.0,
               MessageBytes().Add(0.00025f).bytes());
    if (has_transforms) {
      const double half = std::sqrt(0.5);
      bag->Write(std::string(kDepth) + "/tf/0", "geometry_msgs/Transform", 1.0,
                 MessageBytes().AddEach(std::vector<double>{0, 0, 0, 0, 0, 0, 1}).bytes());
      bag->Write(
          std::string(kColor) + "/tf/0", "geometry_msgs/Transform", 1.0,
          MessageBytes().AddEach(std::vector<double>{0.015, 0, 0, 0, 0, half, half}).bytes());
    }
    for (uint32_t i = 0; i < 3; ++i) {
      const double seconds = 1.0 + i / 30.0;
      bag->Write(std::string(kDepth) + "/image/data", "sensor_msgs/Image", seconds,
                 ImageMessage(100 + i, 0, cv::Mat(12, 16, CV_16UC1, 2000), "mono16"));
      bag->Write(std::string(kColor) + "/image/data", "sensor_msgs/Image", seconds,
                 ImageMessage(100 + i, 0, cv::Mat(24, 32, CV_8UC3, cv::Scalar(1, 2, 3)), "rgb8"));
      bag->Write(std::string(kInfrared) + "/image/data", "sensor_msgs/Image", seconds,
                 ImageMessage(100 + i, 0, cv::Mat(12, 16, CV_8UC1), "8UC1"));
    }
  }
  void WriteNewBag(const std::string& path) {
    const auto bag = WriteDb3Bag(path);
    const auto write_text = [&](const std::string& topic, const std::string& type,
                                const std::string& text) {
      bag->Write(topic, "librealsense/" + type, 0.0, text);
    };
    const auto write_stream = [&](const std::string& stream, const std::string& format,
                                  const std::string& camera, const std::string& transform) {
      write_text(stream + "/info", "stream_info",
                 "is_recommended=false;encoding=" + format + ";fps=30");
      write_text(stream + "/info/camera_info", "camera_info", camera);
      write_text(stream + "/tf/0", "extrinsics", transform);
    };
    write_text("/file_version", "file_version", "4");
    write_text("/device_0/sensor_0/option/Depth_Units/value", "string", "0.000250");
    write_text("/device_0/sensor_0/option/Depth_Units/description", "string", "Number of meters");
    write_stream(kDepth, "Z16",
                 "width=16;height=12;fx=20;ppx=8;fy=20;ppy=6;model=Brown Conrady;"
                 "coeffs=0.000000,0.000000,0.000000,0.000000,0.000000",
                 "rotation=1.000000,0.000000,0.000000,0.000000,1.000000,0.000000,0.000000,0.000000,"
                 "1.000000;translation=0.000000,0.000000,0.000000");
    write_stream(kColor, "RGB8",
                 "width=32;height=24;fx=30;ppx=16;fy=30;ppy=12;model=Inverse Brown Conrady;"
                 "coeffs=0.100000,0.000000,0.000000,0.000000,0.000000",
                 "rotation=0.000000,1.000000,0.000000,-1.000000,0.000000,0.000000,0.000000,"
                 "0.000000,1.000000;translation=0.015000,0.000000,0.000000");
    for (int i = 0; i < 3; ++i) {
      const cv::Mat depth(12, 16, CV_16UC1, 2000), color(24, 32, CV_8UC3, cv::Scalar(1, 2, 3));
      const auto pixels = [](const cv::Mat& image) {
        return std::string(reinterpret_cast<const char*>(image.data),
                           image.total() * image.elemSize());
      };
      bag->Write(std::string(kDepth) + "/image/data", "librealsense/raw_frame", 1.0 + i / 30.0,
                 pixels(depth));
      bag->Write(std::string(kColor) + "/image/data", "librealsense/raw_frame", 1.0 + i / 30.0,
                 pixels(color));
    }
  }
};

TEST_F(RealSenseBagTest, ReadsUnitsAndBothCameras) {
  WriteOldBag(Path("old.bag"));
  WriteNewBag(Path("new.db3"));
  for (const std::string name : {"old.bag", "new.db3"}) {
    SCOPED_TRACE(name);
    SequenceIndex index = OpenBag(Path(name));
    EXPECT_EQ(index.entries.size(), 3u);
    ASSERT_TRUE(index.calibration);
    EXPECT_THAT(index.warnings, IsEmpty());
    EXPECT_EQ(index.depth_scale, 4000.0);
    const Calibration& calibration = *index.calibration;
    EXPECT_EQ(calibration.Recorded().fx, 30.0);
    EXPECT_EQ(calibration.distortion.k[0], 0.1);
    ASSERT_TRUE(calibration.depth_camera);
    EXPECT_EQ(calibration.depth_camera->camera.fx, 20.0);
    EXPECT_EQ(calibration.depth_camera->camera.cy, 6.0);
    EXPECT_EQ(calibration.depth_camera->camera.width, 16);
    // A point 1 m before the depth camera and 0.1 m to its right, from the colour camera to it.
    const Eigen::Vector3d in_color(0.015, 0.1, 1.0);
    EXPECT_LT(
        (calibration.depth_camera->depth_from_color * in_color - Eigen::Vector3d(0.1, 0, 1)).norm(),
        1e-9);
    Calibration resolved = ResolveCalibration({}, "", &index);
    const RgbdImage image = RgbdDecoder(index, resolved).Decode(1);
    EXPECT_NEAR(image.depth.at<float>(12, 16), 0.5, 1e-6);  // 2000 * 0.25 mm
    EXPECT_EQ(image.gray.cols, 32);
  }
}

// Recordings whose depth was aligned to colour before.
TEST_F(RealSenseBagTest, KnowsRegisteredDepth) {
  {
    const auto bag = WriteRos1Bag(Path("x.bag"));
    for (const std::string stream : {kDepth, kColor}) {
      bag->Write(stream + "/info/camera_info", "sensor_msgs/CameraInfo", 1.0,
                 CameraInfoMessage({8, 6, 9.0, 9.0, 4.0, 3.0, "None", {0, 0, 0, 0, 0}}));
      bag->Write(stream + "/tf/0", "geometry_msgs/Transform", 1.0,
                 MessageBytes().AddEach(std::vector<double>{0, 0, 0, 0, 0, 0, 1}).bytes());
      const bool is_depth = stream == kDepth;
      bag->Write(stream + "/image/data", "sensor_msgs/Image", 1.0,
                 ImageMessage(1, 0, cv::Mat::zeros(6, 8, is_depth ? CV_16UC1 : CV_8UC3),
                              is_depth ? "mono16" : "rgb8"));
    }
  }
  const SequenceIndex index = OpenBag(Path("x.bag"));
  EXPECT_FALSE(index.calibration->depth_camera);
  EXPECT_EQ(index.depth_scale, 1000.0);
  EXPECT_THAT(index.warnings, testing::ElementsAre(Names("Depth_Units", "millimetres")));
}

TEST_F(RealSenseBagTest, SaysWhatIsMissing) {
  WriteOldBag(Path("x.bag"), false);
  const SequenceIndex index = OpenBag(Path("x.bag"));
  ASSERT_TRUE(index.calibration->depth_camera);
  EXPECT_EQ(index.calibration->depth_camera->camera.fx, 20.0);
  EXPECT_THAT(index.camera_warnings.depth, Names("Color_0", "transform", "camera.depth_camera"));
}

}  // namespace
}  // namespace msc_vo
