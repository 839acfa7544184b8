// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/ros_image.h"

#include <algorithm>

#include "tests/ros_bag/message_bytes.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

constexpr RosSerialization kRos1 = RosSerialization::kRos1;

std::string Png(const cv::Mat& image) {
  std::vector<uchar> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(RosMessage, ReadsStampsAsInTextFiles) {
  const std::string bytes = MessageBytes().AddHeader(1305031102, 175304000).bytes();
  EXPECT_EQ(ParseRosHeader(bytes, kRos1).stamp, 1305031102.175304);
  EXPECT_EQ(ParseRosHeader(bytes, kRos1).frame, "camera");
}

TEST(RosMessage, RefusesShortMessages) {
  const std::string bytes = ImageMessage(1, 2, cv::Mat::zeros(3, 4, CV_8UC3), "bgr8");
  for (size_t size = 0; size < bytes.size(); size += 5) {
    EXPECT_THROW(ParseRosImage(std::string_view(bytes).substr(0, size), kRos1), std::runtime_error);
  }
  EXPECT_NO_THROW(ParseRosImage(bytes, kRos1));
  EXPECT_THROW(ParseRosCameraInfo(bytes, kRos1), std::runtime_error);
}

TEST(RosImage, ConvertsColours) {
  const cv::Mat bgr(2, 3, CV_8UC3, cv::Scalar(10, 20, 30));
  const cv::Mat rgb(2, 3, CV_8UC3, cv::Scalar(30, 20, 10));
  const auto convert = [](const cv::Mat& image, const std::string& encoding) {
    const std::string bytes = ImageMessage(1, 0, image, encoding);
    return ConvertRosImage(ParseRosImage(bytes, kRos1)).pixels;
  };
  EXPECT_EQ(cv::norm(convert(bgr, "bgr8"), bgr), 0.0);
  EXPECT_EQ(cv::norm(convert(rgb, "rgb8"), bgr), 0.0);
  EXPECT_EQ(convert(cv::Mat(2, 3, CV_8UC4), "rgba8").type(), CV_8UC3);
  EXPECT_EQ(convert(cv::Mat(2, 3, CV_8UC1), "mono8").type(), CV_8UC1);
  EXPECT_EQ(convert(cv::Mat(4, 4, CV_8UC1), "bayer_grbg8").type(), CV_8UC3);
  EXPECT_EQ(convert(cv::Mat(2, 3, CV_16UC1), "16UC1").type(), CV_16UC1);
  EXPECT_EQ(convert(cv::Mat(2, 3, CV_32FC1), "32FC1").type(), CV_32FC1);
  EXPECT_THAT(MessageOf([&] { convert(bgr, "nv24"); }), Names("nv24"));
  EXPECT_THAT(MessageOf([&] { convert(cv::Mat(2, 3, CV_8UC1), "bgr8"); }),
              Names("damaged", "size"));
  const std::string bytes = ImageMessage(1, 0, cv::Mat(2, 3, CV_32FC1), "32FC1");
  RosImage image = ParseRosImage(bytes, kRos1);
  image.height = 1;
  ++image.step;  // no whole number of values
  EXPECT_THAT(MessageOf([&] { ConvertRosImage(image); }), Names("damaged", "size"));
}

TEST(RosImage, ReadsEitherByteOrder) {
  const cv::Mat depth = (cv::Mat_<uint16_t>(1, 3) << 0, 0x1234, 0xFF01);
  const cv::Mat metres = (cv::Mat_<float>(1, 3) << 0.0f, 1.25f, 3.75f);
  const auto read_reversed = [](const cv::Mat& values, const std::string& encoding) {
    cv::Mat reversed = values.clone();
    for (uint8_t* value = reversed.data; value < reversed.dataend; value += values.elemSize()) {
      std::reverse(value, value + values.elemSize());
    }
    const std::string bytes = ImageMessage(1, 0, reversed, encoding);
    RosImage image = ParseRosImage(bytes, kRos1);
    image.is_big_endian = true;
    return ConvertRosImage(image).pixels;
  };
  EXPECT_EQ(cv::norm(read_reversed(depth, "16UC1"), depth), 0.0);
  EXPECT_EQ(cv::norm(read_reversed(depth, "mono16"), depth), 0.0);
  EXPECT_EQ(cv::norm(read_reversed(metres, "32FC1"), metres), 0.0);
  const cv::Mat gray = (cv::Mat_<uint8_t>(1, 3) << 1, 2, 3);
  EXPECT_EQ(cv::norm(read_reversed(gray, "mono8"), gray), 0.0);
}

TEST(RosImage, FindsRedInABayerPattern) {
  // Rows R G / G B: only the red pixels are bright.
  cv::Mat pattern = cv::Mat::zeros(8, 8, CV_8UC1);
  for (int y = 0; y < 8; y += 2) {
    for (int x = 0; x < 8; x += 2) pattern.at<uint8_t>(y, x) = 200;
  }
  const std::string bytes = ImageMessage(1, 0, pattern, "bayer_rggb8");
  const cv::Mat bgr = ConvertRosImage(ParseRosImage(bytes, kRos1)).pixels;
  EXPECT_EQ(bgr.at<cv::Vec3b>(4, 4), cv::Vec3b(0, 0, 200));
}

TEST(RosImage, DecodesCompressedDepth) {
  const std::string header(12, '\0');
  const cv::Mat raw(2, 3, CV_16UC1, cv::Scalar(1234));
  const std::string bytes = CompressedMessage(1, 0, "16UC1; compressedDepth", header + Png(raw));
  EXPECT_EQ(ConvertRosImage(ParseRosCompressedImage(bytes, kRos1)).bytes, Png(raw));

  // Metres are quantised: value = a / depth + b.
  float parameters[3] = {0.0f, 1000.0f, 5.0f};
  const std::string quantised(reinterpret_cast<const char*>(parameters), 12);
  cv::Mat values(1, 2, CV_16UC1);
  values.at<uint16_t>(0, 0) = 505;  // 1000 / 2 m + 5
  values.at<uint16_t>(0, 1) = 0;
  const std::string metres =
      CompressedMessage(1, 0, "32FC1; compressedDepth", quantised + Png(values));
  const cv::Mat depth = ConvertRosImage(ParseRosCompressedImage(metres, kRos1)).pixels;
  EXPECT_FLOAT_EQ(depth.at<float>(0, 0), 2.0f);
  EXPECT_EQ(depth.at<float>(0, 1), 0.0f);

  const std::string damaged = CompressedMessage(1, 0, "16UC1; compressedDepth", header + "no PNG");
  EXPECT_THAT(MessageOf([&] { ConvertRosImage(ParseRosCompressedImage(damaged, kRos1)); }),
              Names("damaged"));
  const uint32_t words[] = {4, 1, 0x04a11040};  // see rvl_test.cc
  const std::string data(reinterpret_cast<const char*>(words), sizeof(words));
  const std::string rvl = CompressedMessage(1, 0, "16UC1; compressedDepth rvl", header + data);
  EXPECT_EQ(ConvertRosImage(ParseRosCompressedImage(rvl, kRos1)).pixels.at<uint16_t>(0, 3), 6);
}

TEST(RosImage, KnowsKindsOfImages) {
  EXPECT_EQ(KindOfEncoding("rgb8"), RosImageKind::kColor);
  EXPECT_EQ(KindOfEncoding("mono8"), RosImageKind::kGray);
  EXPECT_EQ(KindOfEncoding("32FC1"), RosImageKind::kDepth);
  EXPECT_EQ(KindOfEncoding("32FC4"), RosImageKind::kOther);
}

TEST(RosImage, KnowsKindsOfCompressedImages) {
  const auto kind_of = [](const std::string& format, const std::string& data = "") {
    return KindOfCompressed({{}, format, data});
  };
  const auto png = [](int type) {
    std::vector<uint8_t> bytes;
    cv::imencode(".png", cv::Mat::zeros(2, 2, type), bytes);
    return std::string(bytes.begin(), bytes.end());
  };
  EXPECT_EQ(kind_of("rgb8; jpeg compressed bgr8"), RosImageKind::kColor);
  EXPECT_EQ(kind_of("mono8; jpeg compressed "), RosImageKind::kGray);
  EXPECT_EQ(kind_of("jpeg"), RosImageKind::kColor);
  EXPECT_EQ(kind_of("16UC1; compressedDepth"), RosImageKind::kDepth);
  EXPECT_EQ(kind_of("16UC1; png compressed "), RosImageKind::kDepth);
  EXPECT_EQ(kind_of("32FC1; tiff compressed "), RosImageKind::kDepth);
  EXPECT_EQ(kind_of("16UC1; jpeg compressed "), RosImageKind::kOther);
  EXPECT_EQ(kind_of("png", png(CV_16UC1)), RosImageKind::kDepth);
  EXPECT_EQ(kind_of("png", png(CV_8UC3)), RosImageKind::kColor);
}

TEST(RosImage, DecodesCompressedDepthInMetres) {
  const cv::Mat metres(2, 3, CV_32FC1, cv::Scalar(1.25));
  std::vector<uint8_t> tiff;
  ASSERT_TRUE(cv::imencode(".tiff", metres, tiff));
  const std::string data(tiff.begin(), tiff.end());
  const StoredImage image =
      ConvertRosImage(RosCompressedImage{{}, "32FC1; tiff compressed ", data});
  ASSERT_EQ(image.pixels.type(), CV_32FC1);
  EXPECT_EQ(image.pixels.at<float>(1, 2), 1.25f);
}

TEST(RosCamera, TakesTheMatrixThatFitsTheImages) {
  CameraInfoFields fields;
  fields.d = {0.1, -0.2, 0.001, 0.002, 0.05};
  std::string problem;
  const auto calibrate = [&](bool is_rectified) {
    const std::string bytes = CameraInfoMessage(fields);
    return CalibrationFrom(ParseRosCameraInfo(bytes, kRos1), is_rectified, &problem);
  };
  EXPECT_EQ(calibrate(false)->camera.fx, 525.0);
  EXPECT_EQ(calibrate(false)->camera.width, 640);
  EXPECT_EQ(calibrate(false)->distortion.k[4], 0.05);
  EXPECT_EQ(calibrate(true)->camera.fy, 501.0);
  EXPECT_TRUE(calibrate(true)->distortion.IsZero());
  fields.model = "equidistant";
  EXPECT_FALSE(calibrate(false));
  EXPECT_THAT(problem, Names("equidistant"));
  fields.d = {0.02, -0.01, 0.003, -0.001};
  EXPECT_EQ(calibrate(false)->distortion.model, LensModel::kFisheye);
  EXPECT_EQ(calibrate(false)->distortion.k[3], -0.001);
  EXPECT_EQ(calibrate(false)->Recorded().fx, 525.0);
  fields.model = "rational_polynomial";
  fields.d = {0.1, 0.2, 0.001, 0.002, 0.3, 0.0, 0.0, 0.6};
  EXPECT_EQ(calibrate(false)->distortion.model, LensModel::kRational);
  EXPECT_EQ(calibrate(false)->distortion.k[7], 0.6);
  fields.d.back() = 0.0;
  EXPECT_EQ(calibrate(false)->distortion.model, LensModel::kRadialTangential);
  fields.d.push_back(0.1);  // thin prism
  EXPECT_FALSE(calibrate(false));
  fields.fx = 0.0;
  EXPECT_FALSE(calibrate(false));
  EXPECT_THAT(problem, Names("calibrated"));
}

TEST(RosCamera, IsThatOfTheRegionAndTheBinnedPixels) {
  CameraInfoFields fields;
  std::string problem;
  const auto camera = [&] {
    return CalibrationFrom(ParseRosCameraInfo(CameraInfoMessage(fields), kRos1), false, &problem)
        ->camera;
  };
  fields.binning = 2;
  EXPECT_EQ(camera().width, 320);
  EXPECT_EQ(camera().fx, 262.5);
  EXPECT_EQ(camera().cx, 159.5);
  fields.binning = 1;
  fields.roi = {40, 20, 320, 240};
  EXPECT_EQ(camera().height, 240);
  EXPECT_EQ(camera().fx, 525.0);
  EXPECT_EQ(camera().cx, 279.5);
  EXPECT_EQ(camera().cy, 219.5);
}

TEST(RosImages, ConvertsPixelsThatShareTheirColour) {
  for (const auto& [encoding, luma] : {std::pair("yuv422_yuy2", 0), std::pair("yuv422", 1)}) {
    cv::Mat pixels(2, 4, CV_8UC2, cv::Scalar::all(128));
    pixels.at<cv::Vec2b>(1, 2)[luma] = 235;  // white
    EXPECT_EQ(KindOfEncoding(encoding), RosImageKind::kColor);
    const std::string bytes = ImageMessage(1, 0, pixels, encoding);
    const cv::Mat image = ConvertRosImage(ParseRosImage(bytes, kRos1)).pixels;
    ASSERT_EQ(image.type(), CV_8UC3);
    EXPECT_EQ(image.at<cv::Vec3b>(1, 2), cv::Vec3b(255, 255, 255));
    EXPECT_LT(image.at<cv::Vec3b>(1, 1)[0], 140);
  }
}

}  // namespace
}  // namespace msc_vo
