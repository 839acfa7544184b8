// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/rgbd_decoder.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;

class RgbdDecoderTest : public TemporaryFolder {
 protected:
  // Entry i is <i>.png and <i>d.png, one second apart, for a camera of 8 x 6 pixels.
  RgbdDecoder Decoder(int count, bool scale_color = false, const DepthLimits& limits = {}) {
    SequenceIndex index;
    index.scale_color = scale_color;
    index.clipped_depth.limits = limits;
    for (int i = 0; i < count; ++i) {
      const std::string name = std::to_string(i);
      index.entries.push_back(
          {1.0 * i, Path(name + ".png"), Path(name + "d.png"), "rgb.txt:" + std::to_string(i + 1)});
    }
    Calibration calibration;
    calibration.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
    calibration.depth_scale = 1000.0;
    calibration.origin = "camera.txt";
    return {index, calibration};
  }
  std::string ErrorOf(const RgbdDecoder& decoder) {
    return MessageOf([&] { decoder.Decode(0); });
  }
  // Truncates a file to a fraction of its size.
  void Truncate(const std::string& name, double fraction) {
    const auto size = std::filesystem::file_size(Path(name));
    std::filesystem::resize_file(Path(name), static_cast<std::uintmax_t>(fraction * size));
  }
};

TEST_F(RgbdDecoderTest, ConvertsToGreyAndMetres) {
  cv::Mat color(6, 8, CV_8UC3, cv::Scalar(255, 0, 0));  // blue
  cv::imwrite(Path("0.png"), color);
  cv::Mat depth(6, 8, CV_16UC1, cv::Scalar(2500));
  depth.at<uint16_t>(0, 1) = 65535;
  depth.at<uint16_t>(0, 2) = 0;
  cv::imwrite(Path("0d.png"), depth);
  const RgbdImage image = Decoder(1).Decode(0);
  EXPECT_EQ(image.id, 0);
  EXPECT_EQ(image.gray.type(), CV_8UC1);
  EXPECT_EQ(image.depth.type(), CV_32FC1);
  EXPECT_NEAR(image.gray.at<uint8_t>(0, 0), 0.114 * 255, 1.0);
  EXPECT_FLOAT_EQ(image.depth.at<float>(0, 0), 2.5f);
  EXPECT_EQ(image.depth.at<float>(0, 1), 0.0f);
  EXPECT_EQ(image.depth.at<float>(0, 2), 0.0f);
}

TEST_F(RgbdDecoderTest, LeavesOutClippedDepth) {
  WriteColor("0.png");
  const cv::Mat raw = (cv::Mat_<uint16_t>(6, 1) << 0, 500, 800, 2499, 2500, 65535);
  cv::imwrite(Path("0d.png"), cv::repeat(raw, 1, 8));
  const RgbdDecoder decoder = Decoder(1, false, {500.0f, 2500.0f});
  const cv::Mat depth = decoder.Decode(0).depth.col(3);
  EXPECT_LT(cv::norm(depth, cv::Mat((cv::Mat_<float>(6, 1) << 0, 0, 0.8f, 2.499f, 0, 0))), 1e-6);
  EXPECT_EQ(cv::norm(decoder.DecodeRawDepth(0).col(3), raw), 0.0);
  const cv::Mat copy = decoder.ReadForExport(0).depth.pixels.col(3);
  EXPECT_EQ(cv::norm(copy, cv::Mat((cv::Mat_<uint16_t>(6, 1) << 0, 0, 800, 2499, 0, 0))), 0.0);
  EXPECT_THAT(decoder.Warnings(),
              ElementsAre(Names("clipped", "0.500"), Names("clipped", "2.500")));
  EXPECT_TRUE(Decoder(1).Warnings().empty());
}

TEST_F(RgbdDecoderTest, AcceptsGreyAndTransparentImages) {
  WriteDepth("0d.png");
  WriteImage("0.png", CV_8UC1, 77);
  EXPECT_EQ(Decoder(1).Decode(0).gray.at<uint8_t>(2, 2), 77);
  WriteImage("0.png", CV_8UC4, 77);
  EXPECT_EQ(Decoder(1).Decode(0).gray.at<uint8_t>(2, 2), 77);
}

TEST_F(RgbdDecoderTest, ReadsWebpAndPnm) {
  WriteDepth("0d.png");
  const cv::Mat color(6, 8, CV_8UC3, cv::Scalar(30, 200, 120));
  for (const std::string ending : {".webp", ".ppm"}) {
    cv::imwrite(Path("0" + ending), color);
    std::filesystem::rename(Path("0" + ending), Path("0.png"));
    EXPECT_NEAR(Decoder(1).Decode(0).gray.at<uint8_t>(3, 4), 157.0, 3.0) << ending;
  }
  WriteDepth("1.pgm", 2500);
  std::filesystem::rename(Path("1.pgm"), Path("0d.png"));
  EXPECT_FLOAT_EQ(Decoder(1).Decode(0).depth.at<float>(3, 4), 2.5f);
}

TEST_F(RgbdDecoderTest, ConvertsColourJpegToGrey) {
  WriteDepth("0d.png");
  const cv::Mat color(6, 8, CV_8UC3, cv::Scalar(30, 200, 120));
  cv::imwrite(Path("0.jpg"), color);
  std::filesystem::rename(Path("0.jpg"), Path("0.png"));
  const cv::Mat gray = Decoder(1).Decode(0).gray;
  EXPECT_EQ(gray.type(), CV_8UC1);
  EXPECT_NEAR(gray.at<uint8_t>(3, 4), 0.114 * 30 + 0.587 * 200 + 0.299 * 120, 2.0);
}

TEST_F(RgbdDecoderTest, ScalesColourDownIfLayoutRequiresIt) {
  WriteColor("0.png", 16, 12);
  WriteDepth("0d.png");
  EXPECT_EQ(Decoder(1, true).Decode(0).gray.size(), cv::Size(8, 6));
  EXPECT_THAT(ErrorOf(Decoder(1, false)), Names("16x12", "8x6", "register", "camera.txt"));
}

// ScanNet has colour of 1296x968 with depth of 640x480.
TEST_F(RgbdDecoderTest, DoesNotSqueezeColourOfAnotherShape) {
  WriteDepth("0d.png");
  WriteColor("0.png", 16, 9);
  EXPECT_THAT(ErrorOf(Decoder(1, true)), Names("16x9", "8x6", "register", "camera.txt"));
  WriteColor("0.png", 1296, 968);
  WriteDepth("0d.png", 1000, 640, 480);
  SequenceIndex index = Decoder(1, true).index();
  Calibration calibration;
  calibration.camera = {600.0, 600.0, 319.5, 239.5, 640, 480};
  calibration.depth_scale = 1000.0;
  EXPECT_EQ(RgbdDecoder(index, calibration).Decode(0).gray.size(), cv::Size(640, 480));
}

TEST_F(RgbdDecoderTest, RegistersImagesOfDepthCamera) {
  SequenceIndex index;
  index.entries.push_back({0.0, Path("0.png"), Path("0d.png"), "rgb.txt:1"});
  Calibration calibration;
  calibration.camera = {10.0, 10.0, 3.5, 2.5, 8, 6};
  calibration.depth_scale = 1000.0;
  calibration.origin = "camera.txt";
  calibration.depth_camera.emplace();
  calibration.depth_camera->camera = {20.0, 20.0, 7.5, 5.5, 16, 12};
  const RgbdDecoder decoder(index, calibration);
  WriteColor("0.png");
  WriteDepth("0d.png", 2500, 16, 12);
  const RgbdImage image = decoder.Decode(0);
  ASSERT_EQ(image.depth.size(), cv::Size(8, 6));
  EXPECT_NEAR(image.depth.at<float>(3, 4), 2.5, 1e-5);
  EXPECT_EQ(image.recorded_depth.size(), cv::Size(16, 12));
  WriteDepth("0d.png", 2500, 8, 6);
  EXPECT_THAT(ErrorOf(decoder), Names("0d.png", "8x6", "16x12", "camera.txt", "calibration"));
  WriteDepth("0d.png", 2500, 16, 12);
  WriteColor("0.png", 16, 12);
  EXPECT_THAT(ErrorOf(decoder), Names("0.png", "rgb.txt:1", "16x12", "camera.txt", "calibration"));
}

TEST_F(RgbdDecoderTest, ErrorsNameFileLineAndFix) {
  EXPECT_THAT(ErrorOf(Decoder(1)), Names(Path("0.png"), "rgb.txt:1", "exist"));
  WriteColor("0.png");
  WriteDepth("0d.png", 1000, 4, 3);
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0d.png", "4x3", "8x6", "camera.txt"));
  WriteImage("0d.png", CV_8UC1, 100);
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0d.png", "1", "8 bits", "16 bits"));
  WriteImage("0d.tiff", CV_16SC1, 100);
  std::filesystem::rename(Path("0d.tiff"), Path("0d.png"));
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0d.png", "signed", "unsigned", "16 bits"));
  WriteColor("0d.png");
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0d.png", "3", "8 bits"));
  WriteDepth("0.png");
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "swap"));
  WriteDepth("0d.png");
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "16 bits", "8 bits"));
}

TEST_F(RgbdDecoderTest, RejectsDamagedFiles) {
  WriteDepth("0d.png");
  WriteText("0.png", "");
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "0 bytes"));
  WriteText("0.png", "hello");
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "5 bytes"));
  WriteColor("0.png", 200, 200);
  Truncate("0.png", 0.5);
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "truncated"));
}

TEST_F(RgbdDecoderTest, RejectsTruncatedJpeg) {
  WriteDepth("0d.png");
  WriteColor("0.jpg");
  std::filesystem::copy_file(Path("0.jpg"),
                             Path("0.png"));  // the format is determined by the contents
  EXPECT_EQ(ErrorOf(Decoder(1)), "");
  Truncate("0.png", 0.95);
  EXPECT_THAT(ErrorOf(Decoder(1)), Names("0.png", "truncated"));
}

}  // namespace
}  // namespace msc_vo
