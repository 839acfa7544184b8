// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Messages of ROS 2 give the same fields as those of ROS 1.

#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

constexpr RosSerialization kCdr = RosSerialization::kCdr;

TEST(Cdr, ReadsImages) {
  const cv::Mat pixels = (cv::Mat_<uint16_t>(2, 3) << 1, 2, 3, 4, 5, 6);
  // Texts of other lengths move what follows to other alignments.
  for (const std::string encoding : {"16UC1", "mono16", "a", "", "abcdefgh"}) {
    const std::string bytes = ImageMessage(1305031102, 175304000, pixels, encoding, kCdr);
    const RosImage image = ParseRosImage(bytes, kCdr);
    EXPECT_EQ(image.header.stamp, 1305031102.175304);
    EXPECT_EQ(image.encoding, encoding);
    EXPECT_EQ(image.height, 2u);
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.step, 6u);
    EXPECT_FALSE(image.is_big_endian);
    EXPECT_EQ(image.data, std::string_view(reinterpret_cast<const char*>(pixels.data), 12));
  }
}

TEST(Cdr, ReadsCompressedImagesAndCalibrations) {
  const std::string compressed = CompressedMessage(7, 8, "jpeg", "the image", kCdr);
  const RosCompressedImage image = ParseRosCompressedImage(compressed, kCdr);
  EXPECT_EQ(image.format, "jpeg");
  EXPECT_EQ(image.data, "the image");
  for (const size_t num_coefficients : {0, 4, 5, 8}) {
    CameraInfoFields fields;
    fields.model = "plumb_bob";
    fields.d.assign(num_coefficients, 0.25);
    const std::string bytes = CameraInfoMessage(fields, kCdr);
    const RosCameraInfo info = ParseRosCameraInfo(bytes, kCdr);
    EXPECT_EQ(info.distortion_model, fields.model);
    EXPECT_EQ(info.d, fields.d);
    EXPECT_EQ(info.width, 640u);
    EXPECT_EQ(info.k[0], 525.0);
    EXPECT_EQ(info.k[5], 239.5);
    EXPECT_EQ(info.r[8], 1.0);
    EXPECT_EQ(info.p[5], 501.0);
  }
}

// The first bytes say in which order the others are.
TEST(Cdr, ReadsEitherByteOrder) {
  std::string bytes("\0\0\0\0", 4);
  bytes += std::string("\x41\x20\x00\x00", 4);  // 10 as a float with the highest byte first
  EXPECT_EQ(ParseRosFloat(bytes, kCdr), 10.0f);
  EXPECT_EQ(ParseRosFloat(MessageBytes(kCdr).Add(2.5f).bytes(), kCdr), 2.5f);
}

TEST(Cdr, RefusesShortMessagesAndLyingLengths) {
  const std::string bytes = ImageMessage(1, 2, cv::Mat::zeros(3, 4, CV_8UC3), "bgr8", kCdr);
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(ParseRosImage(std::string_view(bytes).substr(0, size), kCdr), std::runtime_error);
  }
  const std::string lying = MessageBytes(kCdr).Add(1u).Add(2u).Add(0xfffffff0u).bytes();
  EXPECT_THAT(MessageOf([&] { ParseRosImage(lying, kCdr); }), Names("too early"));
}

TEST(Cdr, ReadsTransforms) {
  const auto message = [](double w) {
    return MessageBytes(kCdr).AddEach(std::vector{0.1, 0.2, 0.3, 0.0, 0.0, 0.6, w}).bytes();
  };
  const Rigid3 transform = ParseRosTransform(message(0.8), kCdr);
  EXPECT_EQ(transform.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_NEAR(transform.rotation().z(), 0.6, 1e-12);
  EXPECT_THROW(ParseRosTransform(message(2.0), kCdr), std::runtime_error);
}

TEST(Cdr, ReadsTransformsBetweenFrames) {
  const std::vector<ShiftedFrame> frames = {{"/a", "bcd", {1.0, 2.0, 3.0}},
                                            {"efghi", "/", {4.0, 5.0, 6.0}}};
  for (const RosSerialization form : {RosSerialization::kRos1, kCdr}) {
    const std::string bytes = TransformsMessage(frames, form);
    const std::vector<RosFrameTransform> transforms = ParseRosFrameTransforms(bytes, form);
    ASSERT_EQ(transforms.size(), 2u);
    EXPECT_EQ(transforms[0].parent, "a");
    EXPECT_EQ(transforms[0].child, "bcd");
    EXPECT_EQ(transforms[1].child, "");
    EXPECT_EQ(transforms[1].parent_from_child.translation(), Eigen::Vector3d(4.0, 5.0, 6.0));
    EXPECT_THROW(ParseRosFrameTransforms(bytes.substr(0, bytes.size() - 1), form),
                 std::runtime_error);
  }
}

// The matrix is stored column by column; messages of ROS 1 have a header.
TEST(Cdr, ReadsExtrinsicsOfRealSense) {
  const auto add = [](MessageBytes message, double scale) {
    return message.AddEach(std::vector{0.0, scale, 0.0, -scale, 0.0, 0.0, 0.0, 0.0, scale})
        .AddEach(std::vector{0.1, 0.2, 0.3})
        .bytes();
  };
  for (const RosSerialization form : {RosSerialization::kRos1, kCdr}) {
    for (const bool has_header : {true, false}) {
      MessageBytes message(form);
      if (has_header) message.AddHeader(1, 2, "camera");
      const Rigid3 transform = ParseRealSenseExtrinsics(add(message, 1.0), form);
      EXPECT_TRUE((transform * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0.1, 1.2, 0.3)));
      EXPECT_THROW(ParseRealSenseExtrinsics(add(message, 2.0), form), std::runtime_error);
    }
  }
}

}  // namespace
}  // namespace msc_vo
