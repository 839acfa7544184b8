// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/rvl.h"

#include <cstdint>
#include <random>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// An encoder of the codec.
class RvlEncoder {
 public:
  std::string Encode(const cv::Mat& depth) {
    std::string bytes;
    const auto append = [&bytes](uint32_t word) {
      bytes.append(reinterpret_cast<const char*>(&word), sizeof(word));
    };
    append(static_cast<uint32_t>(depth.cols));
    append(static_cast<uint32_t>(depth.rows));
    const auto* const pixels = depth.ptr<uint16_t>();
    const auto size = static_cast<uint32_t>(depth.total());
    int previous = 0;
    for (uint32_t i = 0; i < size;) {
      uint32_t zeros = 0, values = 0;
      while (i + zeros < size && pixels[i + zeros] == 0) ++zeros;
      i += zeros;
      while (i + values < size && pixels[i + values] != 0) ++values;
      Write(zeros);
      Write(values);
      for (uint32_t k = 0; k < values; ++k, ++i) {
        const int difference = pixels[i] - previous;
        Write(difference < 0 ? 2u * static_cast<uint32_t>(-difference) - 1
                             : 2u * static_cast<uint32_t>(difference));
        previous = pixels[i];
      }
    }
    while (nibbles_.size() % 8 != 0) nibbles_.push_back(0);
    for (size_t i = 0; i < nibbles_.size(); i += 8) {
      uint32_t word = 0;
      for (size_t k = 0; k < 8; ++k) word = word << 4 | nibbles_[i + k];
      append(word);
    }
    return bytes;
  }

 private:
  void Write(uint32_t number) {
    for (; number > 7; number >>= 3) nibbles_.push_back(8 | (number & 7));
    nibbles_.push_back(number);
  }

  std::vector<uint32_t> nibbles_;
};

TEST(Rvl, DecodesWhatWasEncoded) {
  std::mt19937 random(1);
  for (const int width : {1, 7, 64}) {
    cv::Mat depth(48, width, CV_16UC1);
    for (int y = 0; y < depth.rows; ++y) {
      for (int x = 0; x < depth.cols; ++x) {
        depth.at<uint16_t>(y, x) =
            random() % 4 == 0 ? 0 : static_cast<uint16_t>(random() % 5 == 0 ? random() : 2000 + x);
      }
    }
    EXPECT_EQ(cv::norm(DecodeRvl(RvlEncoder().Encode(depth)), depth, cv::NORM_INF), 0.0);
  }
  const cv::Mat empty = cv::Mat::zeros(480, 640, CV_16UC1);
  EXPECT_EQ(cv::countNonZero(DecodeRvl(RvlEncoder().Encode(empty))), 0);
}

// Four pixels by hand: no zero, four values, of which the differences are 5, -1, 0 and 2.
TEST(Rvl, DecodesByHand) {
  // The difference d is the number 2 d, or -2 d - 1 if it is negative: 10 (two nibbles), 1, 0, 4.
  const uint32_t words[] = {4, 1, 0x04a11040};
  const std::string bytes(reinterpret_cast<const char*>(words), sizeof(words));
  const cv::Mat expected = (cv::Mat_<uint16_t>(1, 4) << 5, 4, 4, 6);
  EXPECT_EQ(cv::norm(DecodeRvl(bytes), expected, cv::NORM_INF), 0.0);
}

TEST(Rvl, RefusesDamagedData) {
  cv::Mat depth(6, 8, CV_16UC1, cv::Scalar(1234));
  const std::string bytes = RvlEncoder().Encode(depth);
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(DecodeRvl(bytes.substr(0, size)), std::runtime_error);
  }
  std::string huge = bytes;
  huge[3] = '\x7f';  // a width of 2e9
  EXPECT_THAT(MessageOf([&] { DecodeRvl(huge); }), Names("damaged", "RVL"));
  EXPECT_THAT(MessageOf([&] { DecodeRvl(bytes.substr(0, 8) + std::string(16, '\xff')); }),
              Names("damaged"));
}

}  // namespace
}  // namespace msc_vo
