// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/image_header.h"

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace msc_vo {
namespace {

std::string Encode(const std::string& extension, int type) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, cv::Mat(6, 300, type, cv::Scalar::all(9)), bytes));
  return {bytes.begin(), bytes.end()};
}

void ExpectSize(const std::string& bytes, const std::string& what) {
  const std::optional<ImageSize> size = SizeInHeader(bytes);
  ASSERT_TRUE(size.has_value()) << what;
  EXPECT_EQ(size->width, 300) << what;
  EXPECT_EQ(size->height, 6) << what;
  EXPECT_FALSE(DecodeImage(bytes, cv::IMREAD_UNCHANGED).empty()) << what;
}

TEST(SizeInHeader, IsThatOfTheImageInEveryFormat) {
  for (const char* extension : {".png", ".jpg", ".bmp", ".tiff", ".webp", ".ppm"}) {
    ExpectSize(Encode(extension, CV_8UC3), extension);
  }
  for (const char* extension : {".png", ".tiff", ".pgm"}) {
    ExpectSize(Encode(extension, CV_16UC1), extension);
  }
  ExpectSize("P5\n# a comment\n# 7 7\n300 # another\n 6\n255\n" + std::string(1800, 'x'),
             "comments");
}

TEST(SizeInHeader, SkipsSegmentsAndFillBytesOfJpeg) {
  std::string bytes = Encode(".jpg", CV_8UC1);
  const std::string frame("\xFF\xC0\x00\x0B\x08\x00\x01\x00\x01", 9);  // of a preview, 1x1
  bytes.insert(2, std::string("\xFF\xFF\xE1\x00\x0B", 5) + frame);
  ExpectSize(bytes, "a preview in a segment of its own");
}

TEST(SizeInHeader, IsNoneForOtherAndTruncatedFiles) {
  for (const char* extension : {".png", ".jpg", ".bmp", ".tiff", ".webp", ".ppm"}) {
    const std::string bytes = Encode(extension, CV_8UC3);
    for (size_t length = 0; length < std::min<size_t>(bytes.size(), 200); ++length) {
      const std::optional<ImageSize> size = SizeInHeader(bytes.substr(0, length));
      EXPECT_TRUE(!size || size->width <= 300) << extension << " " << length;
    }
  }
  for (const std::string text : {"", "P", "P5", "P5 #", "P5 1", "P9 1 1 ", "P5 99999999999 1 ",
                                 "BM", "hello", "\xFF\xD8\xFF\xFF\xFF", "GIF89a"}) {
    EXPECT_FALSE(SizeInHeader(text).has_value()) << text;
  }
}

TEST(DecodeImage, RefusesAHeaderThatClaimsMoreThanTheFileCanHold) {
  // A JPEG that is complete but for the size in its frame header.
  std::string jpeg = Encode(".jpg", CV_8UC1);
  const size_t frame = jpeg.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\x3A\x98\x3A\x98");  // 15000x15000
  EXPECT_EQ(SizeInHeader(jpeg)->width, 15000);
  EXPECT_TRUE(DecodeImage(jpeg, cv::IMREAD_GRAYSCALE).empty());
  EXPECT_TRUE(DecodeImage("P5\n16000 16000\n255\n12345", cv::IMREAD_UNCHANGED).empty());
}

TEST(DecodeImage, RefusesTiffOfNumbersThatOpenCvDoesNotRead) {
  std::string tiff = Encode(".tiff", CV_32FC1);
  EXPECT_FALSE(DecodeImage(tiff, cv::IMREAD_UNCHANGED).empty());
  const size_t format = tiff.find(std::string("\x53\x01\x03\x00\x01\x00\x00\x00\x03", 9));
  ASSERT_NE(format, std::string::npos);
  tiff[format + 8] = 1;  // unsigned
  EXPECT_THROW(DecodeImage(tiff, cv::IMREAD_UNCHANGED), std::runtime_error);
}

TEST(SizeInHeader, KnowsMarkersOfJpegWithoutALength) {
  // What follows such a marker is the next one, not a length behind which another header is.
  std::string jpeg = Encode(".jpg", CV_8UC1);
  jpeg.insert(2, std::string("\xFF\x01\xFF\xD3", 4));
  EXPECT_EQ(SizeInHeader(jpeg)->width, 300);
}

TEST(IsPlausibleSize, AllowsWhatCamerasProduce) {
  EXPECT_TRUE(IsPlausibleSize({640, 480}, 300));
  EXPECT_TRUE(IsPlausibleSize({4096, 3072}, 20000));  // a black one
  EXPECT_TRUE(IsPlausibleSize({16384, 12288}, 1 << 20));
  EXPECT_FALSE(IsPlausibleSize({0, 480}, 300));
  EXPECT_FALSE(IsPlausibleSize({4096, 3072}, 300));
  EXPECT_FALSE(IsPlausibleSize({16385, 1}, 1 << 20));
}

}  // namespace
}  // namespace msc_vo
