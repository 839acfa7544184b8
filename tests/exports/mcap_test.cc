// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// MCAP files for ROS 2, read by the reader of bags. Expected messages come from another
// implementation of CDR, that of the tests of that reader.

#include <cmath>
#include <cstring>

#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <libdeflate.h>

#include "msc_vo/exports/mcap_export.h"
#include "msc_vo/exports/mcap_writer.h"
#include "msc_vo/exports/ros2_definitions.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using Numbers = std::vector<double>;

MessageBytes Cdr() { return MessageBytes(RosSerialization::kCdr); }

void AddHeader(uint32_t seconds, uint32_t nanoseconds, const std::string& frame,
               MessageBytes* bytes) {
  bytes->Add(seconds).Add(nanoseconds).AddText(frame);
}

// The begin of an array with one marker of a type, at the time of TurnedFrame(), up to its scale.
MessageBytes MarkerArray(const std::string& name, int32_t type) {
  MessageBytes bytes = Cdr();
  bytes.Add(uint32_t{1});
  AddHeader(1305031102, 175304000, "map", &bytes);
  bytes.AddText(name).Add(int32_t{0}).Add(type).Add(int32_t{0});
  bytes.AddEach(Numbers{0, 0, 0, 0, 0, 0, 1});
  return bytes;
}

// The members of a marker after its colours: no text, texture or mesh.
void EndMarker(MessageBytes* bytes) {
  bytes->AddText("");
  AddHeader(0, 0, "", bytes);
  bytes->AddText("").AddArray("").Add(uint32_t{0}).AddText("").AddText("");
  bytes->AddText("").AddArray("").Add(uint8_t{0});
}

// A camera that has walked 3 m forward, 1 m to the right and 2 m down, and turned right by 90
// degrees. In the odometry it has not turned.
McapFrame TurnedFrame() {
  McapFrame frame;
  frame.nanoseconds = 1305031102'175304000;
  frame.world_from_cam = {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY())),
                          {1.0, 2.0, 3.0}};
  frame.odom_from_cam = {Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  PoseCovariance covariance = PoseCovariance::Zero();
  covariance.diagonal() << 1.0, 2.0, 3.0, 4.0, 5.0, 6.0;  // about right, down, forward; along them
  frame.world_covariance = covariance;
  frame.odom_covariance = 2.0 * covariance;
  return frame;
}

class McapExportTest : public TemporaryFolder {
 protected:
  std::unique_ptr<BagFile> Export(const McapRun& run) const {
    ExportMcap(run, Path("x.mcap"));
    return OpenBagFile(Path("x.mcap"));
  }
};

// Reads 36 numbers at the end of a message, or before `num_after` numbers.
Numbers Last36(const std::string& message, size_t num_after = 0) {
  Numbers numbers(36);
  std::memcpy(numbers.data(), message.data() + message.size() - (36 + num_after) * 8, 36 * 8);
  return numbers;
}

TEST_F(McapExportTest, HasPosesAndTransforms) {
  McapRun run;
  run.frames = {TurnedFrame()};
  const auto bag = Export(run);
  ASSERT_NE(bag->FindTopic("/tf"), nullptr);
  EXPECT_EQ(bag->FindTopic("/tf")->type, "tf2_msgs/TFMessage");
  EXPECT_EQ(bag->ReceiveTime("/tf", 0), 1305031102.175304);
  const double half = std::sqrt(0.5);
  // map -> odom: the camera has turned right, which is negative about z, and not moved.
  const std::string pose = bag->Read("/msc_vo/pose", 0);
  MessageBytes expected = Cdr();
  AddHeader(1305031102, 175304000, "map", &expected);
  expected.AddEach(Numbers{3.0, -1.0, -2.0});
  EXPECT_EQ(pose.substr(0, expected.bytes().size()), expected.bytes());
  Numbers quaternion(4);
  std::memcpy(quaternion.data(), pose.data() + expected.bytes().size(), 32);
  EXPECT_NEAR(quaternion[2], -half, 1e-12);
  EXPECT_NEAR(quaternion[3], half, 1e-12);

  const std::string tf = bag->Read("/tf", 0);
  for (const char* frame : {"map", "odom", "camera", "camera_optical_frame"}) {
    EXPECT_THAT(tf, testing::HasSubstr(frame));
  }
  // The last transform, byte for byte.
  MessageBytes optical = Cdr();
  AddHeader(1305031102, 175304000, "camera", &optical);
  optical.AddText("camera_optical_frame");
  optical.AddEach(Numbers{0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5});
  const std::string tail = optical.bytes().substr(optical.bytes().size() - 56);
  EXPECT_EQ(tf.substr(tf.size() - 56), tail);
}

// Order x y z rx ry rz about the fixed axes of the header's frame.
TEST_F(McapExportTest, HasCovariancesInTheFrameOfTheHeader) {
  McapRun run;
  run.frames = {TurnedFrame()};
  const auto bag = Export(run);
  const auto diagonal = [](const Numbers& matrix) {
    Numbers values;
    for (size_t i = 0; i < 6; ++i) values.push_back(matrix[7 * i]);
    return values;
  };
  const auto near = [](const Numbers& values) {
    std::vector<testing::Matcher<double>> matchers;
    for (const double value : values) matchers.push_back(testing::DoubleNear(value, 1e-12));
    return testing::ElementsAreArray(matchers);
  };
  // In the odometry the camera looks along x: its forward axis is x, its right axis -y.
  EXPECT_THAT(diagonal(Last36(bag->Read("/msc_vo/odometry", 0), 42)),
              near({12.0, 8.0, 10.0, 6.0, 2.0, 4.0}));
  // In the map it looks along -y, and its right axis is -x.
  EXPECT_THAT(diagonal(Last36(bag->Read("/msc_vo/pose", 0))), near({4.0, 6.0, 5.0, 1.0, 3.0, 2.0}));
  run.frames[0].world_covariance.reset();  // unknown
  EXPECT_EQ(Last36(Export(run)->Read("/msc_vo/pose", 0)), Numbers(36, 0.0));
}

TEST_F(McapExportTest, HasVelocitiesOfTheCamera) {
  McapFrame after = TurnedFrame();
  after.nanoseconds += 500'000'000;
  // A quarter turn to the right, and a step to the right of 1 m before it: backwards to the left
  // after it.
  after.odom_from_cam = {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY())),
                         {2.0, 2.0, 3.0}};
  McapRun run;
  run.frames = {TurnedFrame(), after};
  const std::string odometry = Export(run)->Read("/msc_vo/odometry", 1);
  Numbers twist(6);
  std::memcpy(twist.data(), odometry.data() + odometry.size() - 42 * 8, 48);
  EXPECT_NEAR(twist[0], 2.0, 1e-12);  // m/s: what was to the right is in front
  EXPECT_NEAR(twist[1], 0.0, 1e-12);
  EXPECT_NEAR(twist[5], -M_PI, 1e-12);  // rad/s
}

TEST_F(McapExportTest, HasTheMap) {
  McapRun run;
  run.frames = {TurnedFrame()};
  run.points = {{{1.0, 2.0, 3.0}, 7}};
  run.lines = {{{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}}, {255, 0, 51}}};
  const auto bag = Export(run);
  MessageBytes cloud = Cdr();
  AddHeader(1305031102, 175304000, "map", &cloud);
  cloud.Add(uint32_t{1}).Add(uint32_t{1}).Add(uint32_t{4});
  const char* const names[] = {"x", "y", "z", "observations"};
  for (uint32_t i = 0; i < 4; ++i) {
    cloud.AddText(names[i]).Add(4 * i).Add(uint8_t(i < 3 ? 7 : 6)).Add(uint32_t{1});
  }
  cloud.Add(uint8_t{0}).Add(uint32_t{16}).Add(uint32_t{16});
  const float xyz[] = {3.0f, -1.0f, -2.0f};
  std::string data(reinterpret_cast<const char*>(xyz), sizeof(xyz));
  cloud.AddArray(data + std::string("\7\0\0\0", 4)).Add(uint8_t{1});
  EXPECT_EQ(bag->Read("/msc_vo/map_points", 0), cloud.bytes());

  MessageBytes lines = MarkerArray("map_lines", 5);
  lines.AddEach(Numbers{0.01, 0, 0});
  for (int i = 0; i < 4; ++i) lines.Add(1.0f);
  lines.Add(int32_t{0}).Add(uint32_t{0}).Add(uint8_t{0});
  lines.Add(uint32_t{2}).AddEach(Numbers{3, -1, -2, 1, 0, 0}).Add(uint32_t{2});
  for (int i = 0; i < 2; ++i) lines.Add(1.0f).Add(0.0f).Add(51.0f / 255.0f).Add(1.0f);
  EndMarker(&lines);
  EXPECT_EQ(bag->Read("/msc_vo/map_lines", 0), lines.bytes());
}

TEST_F(McapExportTest, HasPlanesAsTriangles) {
  McapRun run;
  run.frames = {TurnedFrame()};
  EXPECT_EQ(Export(run)->FindTopic("/msc_vo/map_planes"), nullptr);
  run.planes = {{{{1.0, 2.0, 3.0}, {0.0, 2.0, 3.0}, {0.0, 0.0, 3.0}}, {255, 0, 51}}};
  const auto bag = Export(run);
  ASSERT_NE(bag->FindTopic("/msc_vo/map_planes"), nullptr);
  MessageBytes planes = MarkerArray("map_planes", 11);
  planes.AddEach(Numbers{1, 1, 1});
  for (int i = 0; i < 3; ++i) planes.Add(1.0f);
  planes.Add(0.5f);
  planes.Add(int32_t{0}).Add(uint32_t{0}).Add(uint8_t{0});
  planes.Add(uint32_t{3}).AddEach(Numbers{3, -1, -2, 3, 0, -2, 3, 0, 0}).Add(uint32_t{3});
  for (int i = 0; i < 3; ++i) planes.Add(1.0f).Add(0.0f).Add(51.0f / 255.0f).Add(0.5f);
  EndMarker(&planes);
  EXPECT_EQ(bag->Read("/msc_vo/map_planes", 0), planes.bytes());
}

TEST_F(McapExportTest, HasImagesAsTheyAre) {
  const std::string png = "\x89PNG and the rest";
  WriteText("a.png", png);
  McapRun run;
  run.frames = {TurnedFrame()};
  run.frames[0].image = Path("a.png");
  run.camera.distortion.k = {0.1, 0.2, 0.3, 0.4, 0.5};
  const auto bag = Export(run);
  const std::string image = bag->Read("/camera/color/image_raw/compressed", 0);
  const RosCompressedImage parsed = ParseRosCompressedImage(image, RosSerialization::kCdr);
  EXPECT_EQ(parsed.data, png);
  EXPECT_EQ(parsed.format, "png");
  const std::string info = bag->Read("/camera/color/camera_info", 0);
  const RosCameraInfo camera = ParseRosCameraInfo(info, RosSerialization::kCdr);
  EXPECT_EQ(camera.distortion_model, "plumb_bob");
  EXPECT_EQ(camera.d, (Numbers{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(camera.k[2], 319.5);
  WriteText("a.pgm", "P5");
  run.frames[0].image = Path("a.pgm");
  try {
    ExportMcap(run, Path("y.mcap"));
    ADD_FAILURE() << "an image of another format is written";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), Names("a.pgm", "msc_vo record", "--images"));
  }
}

// Every type in a definition is defined behind it.
TEST(Ros2Schema, HasAllTypesInIt) {
  const McapSchema schema = Ros2Schema("nav_msgs/Odometry");
  EXPECT_EQ(schema.name, "nav_msgs/msg/Odometry");
  EXPECT_THAT(schema.definition, testing::StartsWith("std_msgs/Header header\n"));
  for (const char* type :
       {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseWithCovariance",
        "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion",
        "geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist", "geometry_msgs/Vector3"}) {
    EXPECT_THAT(schema.definition,
                testing::HasSubstr(std::string(80, '=') + "\nMSG: " + type + "\n"));
  }
  EXPECT_THROW(Ros2Schema("nav_msgs/Goals"), std::out_of_range);
}

class McapWriterTest : public TemporaryFolder {
 protected:
  // Messages of 100 kB, so that there are several chunks.
  void Write(int num_messages) const {
    McapWriter writer(Path("x.mcap"));
    const uint16_t a = writer.AddChannel("/a", {"a_msgs/msg/A", "uint8 x\n"});
    for (int i = 0; i < num_messages; ++i) writer.Write(a, 1'000'000'000 + i, Message(i));
    const uint16_t b = writer.AddChannel("/b", {"a_msgs/msg/A", "uint8 x\n"});
    writer.Write(b, 2'000'000'000, Message(0));
    writer.Finish();
  }
  static std::string Message(int i) {
    std::string bytes(100'000, '\0');
    uint32_t state = static_cast<uint32_t>(i) + 1;
    for (char& byte : bytes) {
      state = state * 1664525 + 1013904223;  // cannot be compressed
      byte = static_cast<char>(state >> 24);
    }
    return bytes;
  }
};

TEST_F(McapWriterTest, IsReadBackFromSeveralChunks) {
  Write(30);
  const auto bag = OpenBagFile(Path("x.mcap"));
  ASSERT_EQ(bag->NumMessages("/a"), 30);
  for (const int i : {0, 8, 29}) EXPECT_EQ(bag->Read("/a", i), Message(i)) << i;
  EXPECT_EQ(bag->Read("/b", 0), Message(0));
  EXPECT_EQ(bag->ReceiveTime("/b", 0), 2.0);
  EXPECT_THAT(bag->warnings(), testing::IsEmpty());
}

TEST_F(McapWriterTest, HasASummaryWithItsChecksum) {
  Write(30);
  const std::string file = ReadFile(Path("x.mcap"));
  const auto number = [&](size_t at) {
    uint64_t value = 0;
    std::memcpy(&value, file.data() + at, sizeof(value));
    return value;
  };
  const size_t footer = file.size() - 8 - 20;  // the fields of the footer, then the magic bytes
  EXPECT_EQ(file.substr(footer - 9, 1), "\x02");
  const uint64_t summary = number(footer), offsets = number(footer + 8);
  uint32_t crc = 0;
  std::memcpy(&crc, file.data() + footer + 16, sizeof(crc));
  EXPECT_EQ(libdeflate_crc32(0, file.data() + summary, footer + 16 - summary), crc);
  EXPECT_EQ(file[summary], 3);  // a schema, although two channels have it
  EXPECT_EQ(file[summary + 9 + number(summary + 1)], 4);
  EXPECT_EQ(file[offsets], 14);
}

TEST_F(McapWriterTest, ReadsAsFarAsAFileThatWasCutOff) {
  Write(30);
  const std::string file = ReadFile(Path("x.mcap"));
  WriteText("cut.mcap", file.substr(0, file.size() / 2));
  const auto bag = OpenBagFile(Path("cut.mcap"));
  EXPECT_GT(bag->NumMessages("/a"), 5);
  EXPECT_EQ(bag->Read("/a", 5), Message(5));
}

TEST_F(McapWriterTest, NamesTheFileThatCannotBeWritten) {
  EXPECT_THROW(McapWriter(Path("none/x.mcap")), std::runtime_error);
}

}  // namespace
}  // namespace msc_vo
