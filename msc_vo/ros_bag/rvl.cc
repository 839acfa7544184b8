// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/rvl.h"

#include <cstdint>
#include <stdexcept>

#include "msc_vo/image_files/image_header.h"
#include "msc_vo/ros_bag/little_endian_fields.h"

namespace msc_vo {

namespace {

[[noreturn]] void FailDamaged() {
  throw std::runtime_error("damaged depth image of the codec RVL");
}

// Numbers of a variable number of nibbles with three bits each, the lowest first; the fourth bit
// says that another nibble follows. Eight nibbles make a word, the highest first.
class NibbleReader {
 public:
  explicit NibbleReader(LittleEndianFields words) : words_(words) {}

  uint32_t ReadNumber() {
    uint32_t number = 0;
    for (int shift = 0;; shift += 3) {
      constexpr int kMaxShift = 30;  // of 32 bits
      if (shift > kMaxShift) FailDamaged();
      const uint32_t nibble = ReadNibble();
      number |= (nibble & 7) << shift;
      if ((nibble & 8) == 0) return number;
    }
  }

 private:
  uint32_t ReadNibble() {
    if (num_left_ == 0) {
      if (words_.size() < sizeof(word_)) FailDamaged();
      word_ = words_.Read<uint32_t>();
      num_left_ = 8;
    }
    --num_left_;
    return (word_ >> (4 * num_left_)) & 15;
  }

  LittleEndianFields words_;
  uint32_t word_ = 0;
  int num_left_ = 0;
};

}  // namespace

cv::Mat DecodeRvl(std::string_view bytes) {
  LittleEndianFields fields(bytes);
  const auto width = fields.Read<uint32_t>(), height = fields.Read<uint32_t>();
  const ImageSize image_size = {static_cast<int>(width), static_cast<int>(height)};
  if (!IsPlausibleSize(image_size, bytes.size())) FailDamaged();
  cv::Mat depth = cv::Mat::zeros(image_size.height, image_size.width, CV_16UC1);
  NibbleReader reader(fields);
  auto* const pixels = depth.ptr<uint16_t>();
  const size_t size = depth.total();
  uint32_t value = 0;
  // Runs of pixels without measurement, and of measured ones as differences to the one before.
  for (size_t i = 0; i < size;) {
    const uint32_t num_zeros = reader.ReadNumber();
    if (num_zeros > size - i) FailDamaged();
    i += num_zeros;
    const uint32_t num_values = reader.ReadNumber();
    if (num_values > size - i || (num_zeros == 0 && num_values == 0)) FailDamaged();
    for (uint32_t k = 0; k < num_values; ++k) {
      const uint32_t difference = reader.ReadNumber();  // the sign is its lowest bit
      value += (difference >> 1) ^ (0u - (difference & 1));
      pixels[i++] = static_cast<uint16_t>(value);
    }
  }
  return depth;
}

}  // namespace msc_vo
