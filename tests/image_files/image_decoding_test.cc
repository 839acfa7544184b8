// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The decoders of common images against those of OpenCV.

#include <cstdlib>
#include <fstream>
#include <new>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "msc_vo/image_files/image_file.h"
#include "msc_vo/image_files/jpeg_image.h"
#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/image_files/png_filter.h"
#include "msc_vo/image_files/png_image.h"

namespace msc_vo {
namespace {

constexpr int kGray = cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION;

// Noise on a slope: every filter of PNG occurs.
cv::Mat RandomImage(int width, int height, int type, int seed) {
  cv::Mat image(height, width, type);
  cv::RNG random(seed);
  random.fill(image, cv::RNG::UNIFORM, 0, seed % 2 == 0 ? 9 : 250);
  for (int i = 0; i < height; ++i) image.row(i) += cv::Scalar::all(i * (seed % 3));
  return image;
}

std::string Encode(const std::string& extension, const cv::Mat& image,
                   const std::vector<int>& parameters = {}) {
  std::vector<uint8_t> bytes;
  EXPECT_TRUE(cv::imencode(extension, image, bytes, parameters));
  return {bytes.begin(), bytes.end()};
}

bool AreSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0.0);
}

// The filter of the PNG specification, byte by byte.
std::vector<uint8_t> Filter(int type, int pixel_bytes, const std::vector<uint8_t>& above,
                            const std::vector<uint8_t>& row) {
  std::vector<uint8_t> filtered = {static_cast<uint8_t>(type)};
  for (size_t i = 0; i < row.size(); ++i) {
    const bool has_left = i >= static_cast<size_t>(pixel_bytes);
    const int a = has_left ? row[i - pixel_bytes] : 0;
    const int b = above[i];
    const int c = has_left ? above[i - pixel_bytes] : 0;
    const int p = a + b - c;
    const int pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
    const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
    const int predictions[] = {0, a, b, (a + b) / 2, paeth};
    filtered.push_back(static_cast<uint8_t>(row[i] - predictions[type]));
  }
  return filtered;
}

TEST(UndoPngFilters, GivesBackThePixelsOfEveryFilter) {
  std::mt19937 random(3);
  for (int pixel_bytes : {1, 2, 3, 4}) {
    const size_t row_bytes = 37 * pixel_bytes;
    std::vector<uint8_t> above(row_bytes), filtered;
    std::vector<std::vector<uint8_t>> rows;
    for (int i = 0; i < 60; ++i) {
      std::vector<uint8_t> row(row_bytes);
      for (uint8_t& byte : row) byte = static_cast<uint8_t>(random() % (i % 2 == 0 ? 256 : 5));
      for (uint8_t byte : Filter(i < 30 ? i % 5 : 4 - i / 4 % 2, pixel_bytes, above, row))
        filtered.push_back(byte);
      rows.push_back(row);
      above = row;
    }
    ASSERT_TRUE(UndoPngFilters(pixel_bytes, row_bytes, 60, filtered.data()));
    for (size_t i = 0; i < rows.size(); ++i) {
      const auto begin = filtered.begin() + i * (row_bytes + 1) + 1;
      EXPECT_EQ(std::vector<uint8_t>(begin, begin + row_bytes), rows[i]) << pixel_bytes << " " << i;
    }
  }
}

TEST(UndoPngFilters, RefusesUnknownFilters) {
  std::vector<uint8_t> rows = {5, 1, 1};
  EXPECT_FALSE(UndoPngFilters(1, 2, 1, rows.data()));
}

TEST(DecodePng, GivesThePixelsThatOpenCvGives) {
  for (int type : {CV_8UC1, CV_16UC1, CV_8UC3, CV_8UC4}) {
    for (int seed = 0; seed < 6; ++seed) {
      const cv::Mat image = RandomImage(61 + seed, 40, type, seed);
      const std::string bytes = Encode(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 1 + seed});
      EXPECT_TRUE(AreSame(DecodePng(bytes), image)) << type << " " << seed;
      EXPECT_TRUE(AreSame(DecodeImage(bytes, cv::IMREAD_UNCHANGED), image)) << type << " " << seed;
    }
  }
}

TEST(DecodePng, LeavesOtherKindsToOpenCv) {
  const std::string deep = Encode(".png", RandomImage(20, 30, CV_16UC3, 1));
  const std::string bits =
      Encode(".png", RandomImage(20, 30, CV_8UC1, 1), {cv::IMWRITE_PNG_BILEVEL, 1});
  for (const std::string& bytes : {deep, bits}) {
    EXPECT_TRUE(DecodePng(bytes).empty());
    const cv::Mat image = DecodeImage(bytes, cv::IMREAD_UNCHANGED);
    EXPECT_FALSE(image.empty());
    EXPECT_TRUE(AreSame(image, DecodeWithOpenCv(bytes, cv::IMREAD_UNCHANGED)));
  }
}

TEST(DecodePng, RefusesEveryDamage) {
  const std::string whole = Encode(".png", RandomImage(16, 12, CV_16UC1, 2));
  for (size_t length = 0; length < whole.size(); ++length) {
    EXPECT_TRUE(DecodePng(whole.substr(0, length)).empty()) << length;
  }
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x15);
    EXPECT_TRUE(DecodePng(damaged).empty()) << i;
  }
}

TEST(DecodeJpeg, GivesThePixelsThatOpenCvGives) {
  for (int quality : {30, 75, 98}) {
    const std::string gray =
        Encode(".jpg", RandomImage(61, 47, CV_8UC1, quality), {cv::IMWRITE_JPEG_QUALITY, quality});
    const std::string color =
        Encode(".jpg", RandomImage(61, 47, CV_8UC3, quality), {cv::IMWRITE_JPEG_QUALITY, quality});
    for (const std::string& bytes : {gray, color}) {
      EXPECT_TRUE(AreSame(DecodeJpeg(bytes, JpegChannels::kGray), DecodeWithOpenCv(bytes, kGray)));
      EXPECT_TRUE(AreSame(DecodeJpeg(bytes, JpegChannels::kStored),
                          DecodeWithOpenCv(bytes, cv::IMREAD_UNCHANGED)));
      EXPECT_TRUE(AreSame(DecodeImage(bytes, kGray), DecodeWithOpenCv(bytes, kGray)));
    }
  }
}

TEST(DecodeJpeg, RefusesMorePixelsThanTheFileCanHold) {
  std::string jpeg = Encode(".jpg", RandomImage(61, 47, CV_8UC1, 1));
  jpeg.replace(jpeg.find("\xFF\xC0") + 5, 4, "\x7F\xDC\x7F\xDC");  // 32732 x 32732
  EXPECT_TRUE(DecodeJpeg(jpeg, JpegChannels::kGray).empty());
}

TEST(DecodeJpeg, AcceptsStrayBytesAsCamerasWriteThem) {
  std::string jpeg = Encode(".jpg", RandomImage(61, 47, CV_8UC1, 1));
  jpeg.insert(jpeg.size() - 2, "xyz");
  const cv::Mat image = DecodeJpeg(jpeg, JpegChannels::kGray);
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(AreSame(image, DecodeWithOpenCv(jpeg, kGray)));
}

TEST(DecodeImage, GivesAnEmptyImageForDamage) {
  const std::string png = Encode(".png", RandomImage(16, 12, CV_16UC1, 2));
  const std::string jpeg = Encode(".jpg", RandomImage(16, 12, CV_8UC1, 2));
  EXPECT_TRUE(DecodeImage(png.substr(0, png.size() / 2), cv::IMREAD_UNCHANGED).empty());
  for (size_t length = 0; length + 1 < jpeg.size(); ++length) {
    EXPECT_TRUE(DecodeImage(jpeg.substr(0, length), kGray).empty()) << length;
    EXPECT_TRUE(DecodeImage(jpeg.substr(0, length), cv::IMREAD_COLOR).empty()) << length;
  }
  const char num_bytes[] = {static_cast<char>((jpeg.size() + 2) >> 8),
                            static_cast<char>((jpeg.size() + 2) & 0xFF)};
  const std::string preview = "\xFF\xE1" + std::string(num_bytes, 2) + jpeg;
  const std::string with_preview = jpeg.substr(0, 2) + preview + jpeg.substr(2);
  EXPECT_FALSE(DecodeImage(with_preview, kGray).empty());
  for (size_t length = 0; length + 1 < with_preview.size(); ++length) {
    EXPECT_TRUE(DecodeImage(with_preview.substr(0, length), kGray).empty()) << length;
  }
  EXPECT_TRUE(DecodeImage("", cv::IMREAD_UNCHANGED).empty());
}

// A time without data, with a checksum that matches or not: it changes no pixel.
std::string WithBadTime(std::string png, bool is_intact) {
  constexpr size_t kHeaderEnd = 33;
  const char* const checksum = is_intact ? "\xF9\x33\xDA\xCF" : "????";
  return png.insert(kHeaderEnd, std::string(4, '\0') + "tIME" + checksum);
}

// libpng and libjpeg print warnings and errors if nobody prevents them.
TEST(DecodeImage, PrintsNothingAboutDamage) {
  const cv::Mat color = RandomImage(16, 12, CV_8UC3, 2);
  const std::string png = Encode(".png", color), jpeg = Encode(".jpg", color);
  const std::string depth = Encode(".png", RandomImage(16, 12, CV_16UC1, 2));
  testing::internal::CaptureStderr();
  for (const int mode : {kGray, static_cast<int>(cv::IMREAD_UNCHANGED)}) {
    for (const std::string& whole : {png, jpeg, depth}) {
      for (size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x15);
        DecodeImage(damaged, mode);
        DecodeImage(whole.substr(0, i), mode);
      }
    }
    for (const bool is_intact : {false, true}) {
      EXPECT_TRUE(AreSame(DecodeImage(WithBadTime(png, is_intact), mode), DecodeImage(png, mode)));
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(EssentialPng, LeavesOutWhatChangesNoPixel) {
  const std::string png = Encode(".png", RandomImage(16, 12, CV_16UC3, 2));
  EXPECT_TRUE(IsPng(png));
  EXPECT_FALSE(IsPng(png.substr(1)));
  EXPECT_EQ(EssentialPng(png), png);
  EXPECT_EQ(EssentialPng(WithBadTime(png, true)), png);
  EXPECT_EQ(EssentialPng(WithBadTime(png, false)), png);
  EXPECT_EQ(EssentialPng(png.substr(0, png.size() - 1)), "");
}

TEST(EncodeJpeg, CanBeDecoded) {
  const cv::Mat slope = RandomImage(64, 48, CV_8UC1, 2);
  const cv::Mat decoded = DecodeJpeg(EncodeJpeg(slope, 95), JpegChannels::kGray);
  ASSERT_EQ(decoded.size(), slope.size());
  EXPECT_LT(cv::norm(decoded, slope, cv::NORM_L1) / slope.total(), 3.0);
  EXPECT_LT(EncodeJpeg(slope, 20).size(), EncodeJpeg(slope, 95).size());
}

// Decodes in a process that may take a few more megabytes than it has. Exit code: 0 decoded, 1
// taken for damaged, 2 lack of memory.
[[noreturn]] void DecodeWithin(size_t more_bytes, const std::string& bytes, int mode) {
  size_t num_pages = 0;
  std::ifstream("/proc/self/statm") >> num_pages;
  const rlim_t limit = num_pages * static_cast<size_t>(sysconf(_SC_PAGESIZE)) + more_bytes;
  const rlimit limits = {limit, limit};
  setrlimit(RLIMIT_AS, &limits);
  try {
    std::exit(DecodeImage(bytes, mode).empty() ? 1 : 0);
  } catch (const std::bad_alloc&) {
    std::exit(2);
  }
}

// A run without enough memory ends; an image that it took for damaged would change its results.
TEST(DecodeImageDeathTest, TellsLackOfMemoryFromDamage) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer reserves far more address space than any limit";
#endif
  const cv::Mat image = RandomImage(3000, 3000, CV_8UC3, 1);  // 27 MB
  const std::string png = Encode(".png", image), jpeg = Encode(".jpg", image);
  constexpr size_t kMegabyte = size_t{1} << 20;
  for (const size_t megabytes : {1, 10, 20, 30, 40}) {
    EXPECT_EXIT(
        DecodeWithin(megabytes * kMegabyte, png, cv::IMREAD_UNCHANGED),
        [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) != 1; }, "");
    EXPECT_EXIT(
        DecodeWithin(megabytes * kMegabyte, jpeg, kGray),
        [](int status) { return WIFEXITED(status) && WEXITSTATUS(status) != 1; }, "");
  }
  EXPECT_EXIT(DecodeWithin(kMegabyte, png, cv::IMREAD_UNCHANGED), testing::ExitedWithCode(2), "");
}

}  // namespace
}  // namespace msc_vo
