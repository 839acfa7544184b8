// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The cameras that bags describe: CameraInfo, coordinate frames and the transforms between them.

#include "msc_vo/ros_bag/bag_calibration.h"

#include <memory>
#include <optional>

#include "tests/ros_bag/bag_writer.h"
#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/ros_bag/bag_sequence.h"
#include "msc_vo/text/ending.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr char kColorTopic[] = "/camera/color/image_raw";
constexpr char kDepthTopic[] = "/camera/depth/image_raw";

// Depth is 50 mm to the left of colour.
const std::vector<ShiftedFrame> kTransforms = {{"link", "depth", {0.0, 0.0, 0.0}},
                                               {"link", "color", {0.05, 0.0, 0.0}}};

CameraInfoFields InfoIn(const std::string& frame, double fx = 525.0) {
  CameraInfoFields info;
  info.width = 32, info.height = 24, info.cx = 15.5, info.cy = 11.5;
  info.fx = fx, info.frame = frame;
  return info;
}

class BagCalibrationTest : public TemporaryFolder {
 protected:
  // Begins a bag of ROS 1, or of ROS 2 if its name ends in .db3.
  void Begin(const std::string& name) {
    bag_ = HasEnding(name, ".db3") ? WriteDb3Bag(Path(name)) : WriteRos1Bag(Path(name));
    name_ = name;
  }
  void WriteColor(const std::string& frame, const std::string& topic = kColorTopic) {
    WriteImage(topic, cv::Mat(24, 32, CV_8UC3, cv::Scalar::all(9)), "bgr8", frame);
  }
  void WriteDepth(const std::string& frame, const std::string& topic = kDepthTopic) {
    WriteImage(topic, cv::Mat(24, 32, CV_16UC1, 1000), "16UC1", frame);
  }
  void WriteInfo(const std::string& topic, const CameraInfoFields& info) {
    Write(topic, "sensor_msgs/CameraInfo", CameraInfoMessage(info, bag_->serialization()));
  }
  // Both cameras with their images.
  void WriteCameras(const std::string& color_frame, const std::string& depth_frame,
                    double depth_fx = 525.0) {
    WriteColor(color_frame);
    WriteInfo("/camera/color/camera_info", InfoIn(color_frame));
    WriteDepth(depth_frame);
    WriteInfo("/camera/depth/camera_info", InfoIn(depth_frame, depth_fx));
  }
  void WriteTransforms(const std::string& topic, const std::vector<ShiftedFrame>& transforms,
                       const std::string& type = "tf2_msgs/TFMessage") {
    Write(topic, type, TransformsMessage(transforms, bag_->serialization()));
  }
  void Write(const std::string& topic, const std::string& type, const std::string& bytes) {
    bag_->Write(topic, type, 1.0, bytes);
  }
  SequenceIndex Open() {
    bag_.reset();
    return OpenBag(Path(name_));
  }
  SequenceIndex OpenWithoutWarning() {
    SequenceIndex index = Open();
    EXPECT_THAT(index.warnings, IsEmpty());
    EXPECT_EQ(index.camera_warnings.color, "");
    EXPECT_EQ(index.camera_warnings.depth, "");
    return index;
  }
  void ExpectDepthCameraToTheLeft(double fx = 525.0) {
    const SequenceIndex index = OpenWithoutWarning();
    ASSERT_TRUE(index.calibration && index.calibration->depth_camera);
    const DepthCamera& camera = *index.calibration->depth_camera;
    EXPECT_EQ(camera.camera.fx, fx);
    const Eigen::Vector3d t = camera.depth_from_color.translation();
    EXPECT_LT((t - Eigen::Vector3d(0.05, 0.0, 0.0)).norm(), 1e-9);
  }
  void ExpectRegistered() {
    const SequenceIndex index = OpenWithoutWarning();
    ASSERT_TRUE(index.calibration);
    EXPECT_FALSE(index.calibration->depth_camera);
  }
  // `fx`: of the depth camera, which is taken for one at the place of colour; 0: none.
  void ExpectUnknownPlace(double fx) {
    const SequenceIndex index = Open();
    EXPECT_THAT(index.warnings, IsEmpty());
    EXPECT_THAT(index.camera_warnings.depth,
                Names(kDepthTopic, kColorTopic, "--camera-file", "/tf_static"));
    ASSERT_TRUE(index.calibration);
    const std::optional<DepthCamera>& camera = index.calibration->depth_camera;
    ASSERT_EQ(camera.has_value(), fx > 0.0);
    if (!camera) return;
    EXPECT_EQ(camera->camera.fx, fx);
    EXPECT_EQ(camera->depth_from_color.translation().norm(), 0.0);
  }

  static void ExpectWarnings(SequenceIndex index, const CameraSettings& settings, size_t count) {
    ResolveCalibration(settings, "", &index);
    EXPECT_EQ(index.warnings.size(), count);
  }

 private:
  void WriteImage(const std::string& topic, const cv::Mat& image, const std::string& encoding,
                  const std::string& frame) {
    Write(topic, "sensor_msgs/Image",
          ImageMessage(1, 0, image, encoding, bag_->serialization(), frame));
  }

  std::unique_ptr<BagWriter> bag_;
  std::string name_;
};

TEST_F(BagCalibrationTest, ReadsThePlaceOfTheDepthCamera) {
  Begin("x.bag");
  WriteCameras("color", "/depth");
  WriteTransforms("/tf_static", kTransforms, "tf/tfMessage");
  ExpectDepthCameraToTheLeft();
  for (const double fx : {525.0, 527.0, 400.0}) {
    Begin(std::to_string(fx) + ".db3");
    WriteCameras("color", "depth", fx);
    WriteTransforms("/tf_static", {kTransforms[0]});
    WriteTransforms("/tf_static", {kTransforms[1]});
    ExpectDepthCameraToTheLeft(fx);
  }
}

// Nodes of ROS 1 publish fixed transforms again and again, among those of a robot that moves.
TEST_F(BagCalibrationTest, ReadsFixedTransformsAmongOthers) {
  Begin("x.bag");
  WriteCameras("color", "depth");
  for (const double x : {0.0, 1.0, 2.0}) {
    WriteTransforms("/tf", kTransforms);
    WriteTransforms("/tf", {{"map", "link", {x, 0.0, 0.0}}});
  }
  ExpectDepthCameraToTheLeft();
}

TEST_F(BagCalibrationTest, ReadsTheExtrinsicsOfTheDriver) {
  Begin("x.bag");
  WriteCameras("color", "depth");
  Write("/camera/extrinsics/depth_to_color", "realsense2_camera/Extrinsics",
        MessageBytes()
            .AddHeader(1, 0)
            .AddEach(std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1, -0.05, 0, 0})
            .bytes());
  ExpectDepthCameraToTheLeft();
}

TEST_F(BagCalibrationTest, WarnsIfThePlaceIsNotKnown) {
  Begin("x.bag");
  WriteCameras("color", "depth", 400.0);
  ExpectUnknownPlace(400.0);
  Begin("same.bag");
  WriteCameras("color", "depth");
  ExpectUnknownPlace(0.0);
  Begin("moves.bag");
  WriteCameras("color", "depth", 400.0);
  WriteTransforms("/tf", {kTransforms[0]});
  for (const double x : {0.0, 1.0}) WriteTransforms("/tf", {{"link", "color", {x, 0.0, 0.0}}});
  ExpectUnknownPlace(400.0);
  Begin("far.bag");
  WriteCameras("color", "depth", 400.0);
  WriteTransforms("/tf_static", {{"depth", "color", {50.0, 0.0, 0.0}}});
  ExpectUnknownPlace(400.0);
  Begin("damaged.bag");
  WriteCameras("color", "depth", 400.0);
  Write("/tf_static", "tf2_msgs/TFMessage", "short");
  ExpectUnknownPlace(400.0);
}

TEST_F(BagCalibrationTest, WarnsIfTheDepthCameraIsNotKnown) {
  Begin("x.bag");
  WriteColor("color");
  WriteInfo("/camera/color/camera_info", InfoIn("color"));
  WriteDepth("depth");
  WriteTransforms("/tf_static", kTransforms);
  ExpectUnknownPlace(0.0);
}

TEST_F(BagCalibrationTest, KnowsRegisteredDepth) {
  Begin("x.bag");
  WriteCameras("/color", "color", 400.0);
  ExpectRegistered();
  Begin("named.bag");
  WriteColor("color");
  WriteInfo("/camera/color/camera_info", InfoIn("color"));
  WriteDepth("depth", "/camera/depth_to_rgb/image_raw");
  WriteTransforms("/tf_static", kTransforms);
  ExpectRegistered();
  // Drivers that register have frames of one place, too.
  Begin("one.bag");
  WriteCameras("color", "depth");
  WriteTransforms("/tf_static", {{"color", "depth", {0.0, 0.0, 0.0}}});
  ExpectRegistered();
  // Without frames, nothing speaks against it but other intrinsics.
  Begin("frameless.bag");
  WriteCameras("", "", 527.0);
  ExpectRegistered();
  Begin("other.bag");
  WriteCameras("", "", 400.0);
  ExpectUnknownPlace(400.0);
}

TEST_F(BagCalibrationTest, WarnsOfACameraInfoOfDepthThatIsNotRegistered) {
  for (const std::string topic : {"/camera/depth", "/camera/depth_registered"}) {
    const std::string name = topic.substr(8) + ".bag";
    Begin(name);
    WriteColor("");
    WriteDepth("", topic + "/image");
    WriteInfo(topic + "/camera_info", InfoIn(""));
    const SequenceIndex index = Open();
    EXPECT_EQ(index.calibration->camera.fx, 525.0);
    const std::string& warning = index.camera_warnings.color;
    if (topic == "/camera/depth_registered") {
      EXPECT_EQ(warning, "");
      continue;
    }
    EXPECT_THAT(warning, Names(kColorTopic, topic + "/camera_info", "--camera-file"));
  }
}

// The first message may be older than the calibration, or of another setting of the camera.
TEST_F(BagCalibrationTest, ReadsTheCameraInfoOfMostImages) {
  for (const double first : {0.0, 400.0, 525.0}) {
    Begin("infos.bag");
    WriteInfo("/camera/color/camera_info", InfoIn("color", first));
    for (int i = 0; i < 3; ++i) WriteInfo("/camera/color/camera_info", InfoIn("color"));
    WriteColor("color");
    WriteDepth("color");
    const SequenceIndex index = Open();
    ASSERT_TRUE(index.calibration);
    EXPECT_EQ(index.calibration->camera.fx, 525.0);
    const auto is_warning = Names("/camera/color/camera_info, message 0", "message 3");
    EXPECT_THAT(index.warnings, testing::Contains(is_warning).Times(first == 400.0 ? 1 : 0));
  }
}

TEST_F(BagCalibrationTest, ReadsTheFirstCameraInfoIfLaterOnesDescribeNone) {
  for (const bool is_damaged : {false, true}) {
    Begin("infos.bag");
    WriteInfo("/camera/color/camera_info", InfoIn("color"));
    for (int i = 0; i < 3; ++i) {
      if (is_damaged) Write("/camera/color/camera_info", "sensor_msgs/CameraInfo", "short");
      if (!is_damaged) WriteInfo("/camera/color/camera_info", InfoIn("color", 0.0));
    }
    WriteColor("color");
    WriteDepth("color");
    const SequenceIndex index = Open();
    ASSERT_TRUE(index.calibration);
    EXPECT_EQ(index.calibration->camera.fx, 525.0);
    const auto is_warning = Names("/camera/color/camera_info, message 3");
    EXPECT_THAT(index.warnings, testing::Contains(is_warning).Times(is_damaged ? 1 : 0));
  }
}

TEST_F(BagCalibrationTest, ReadsTheMessagesBesideDamagedOnes) {
  Begin("first.bag");
  Write("/camera/color/camera_info", "sensor_msgs/CameraInfo", "short");
  WriteCameras("color", "depth");
  Write("/tf_static", "tf2_msgs/TFMessage", "short");
  WriteTransforms("/tf_static", kTransforms);
  const SequenceIndex index = Open();
  ASSERT_TRUE(index.calibration && index.calibration->depth_camera);
  EXPECT_THAT(index.warnings, ElementsAre(Names("/camera/color/camera_info, message 0")));
  EXPECT_EQ(index.camera_warnings.color + index.camera_warnings.depth, "");
}

TEST_F(BagCalibrationTest, WarnsOfNoCameraThatTheUserGives) {
  Begin("x.bag");
  WriteCameras("color", "depth", 400.0);
  const SequenceIndex of_other_camera = Open();
  ExpectWarnings(of_other_camera, CameraSettings(), 1);
  CameraSettings settings = SettingsOf(*of_other_camera.calibration);
  ExpectWarnings(of_other_camera, settings, 0);

  Begin("y.bag");
  WriteColor("");
  WriteDepth("", "/camera/depth/image");
  WriteInfo("/camera/depth/camera_info", InfoIn(""));
  const SequenceIndex without_color = Open();
  ExpectWarnings(without_color, CameraSettings(), 1);
  settings.depth_camera = DepthCameraSettings();
  ExpectWarnings(without_color, settings, 0);
}

TEST_F(BagCalibrationTest, GoesOnWithoutADamagedCameraInfo) {
  Begin("x.bag");
  WriteCameras("color", "color");
  Write("/other/camera_info", "sensor_msgs/CameraInfo", "short");
  const SequenceIndex index = Open();
  EXPECT_TRUE(index.calibration);
  EXPECT_THAT(index.warnings, ElementsAre(Names("/other/camera_info")));
}

TEST_F(BagCalibrationTest, TakesTheCameraInfoInTheFrameOfTheImages) {
  Begin("x.bag");
  WriteColor("color");
  WriteDepth("color");
  CameraInfoFields larger = InfoIn("color", 1050.0);
  larger.width = 64;
  WriteInfo("/hd_camera_info", larger);
  WriteInfo("/other_camera_info", InfoIn("other", 400.0));
  WriteInfo("/rgb_camera_info", InfoIn("color"));
  ExpectRegistered();
  Begin("none.bag");
  WriteColor("color");
  WriteDepth("color");
  WriteInfo("/other_camera_info", InfoIn("other"));
  const SequenceIndex index = Open();
  EXPECT_FALSE(index.calibration);
  EXPECT_THAT(index.camera_warnings.color, Names(kColorTopic, "/other_camera_info", "other"));
}

}  // namespace
}  // namespace msc_vo
