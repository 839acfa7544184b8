// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/png_image.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string_view>

#include <libdeflate.h>

#include "msc_vo/image_files/image_header.h"
#include "msc_vo/image_files/png_filter.h"

namespace msc_vo {

namespace {

uint32_t BigEndian(const char* bytes) {
  uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

struct Chunk {
  std::string_view type;
  std::string_view data;
  bool is_intact = false;  // its checksum matches

  // Whether no image can be decoded without it, as the case of the first letter says.
  bool IsNeeded() const {
    constexpr char kLowerCase = 0x20;
    return (type[0] & kLowerCase) == 0;
  }
};

// Length, type, data and checksum of the chunk at a position, which moves behind it; none if the
// file ends before it, or if it is needed and its checksum does not match.
std::optional<Chunk> NextChunk(const std::string& bytes, size_t* at) {
  constexpr size_t kNumOtherBytes = 12;
  if (bytes.size() - *at < kNumOtherBytes) return std::nullopt;
  const char* const begin = bytes.data() + *at;
  const size_t num_bytes = BigEndian(begin);
  if (bytes.size() - *at - kNumOtherBytes < num_bytes) return std::nullopt;
  const bool is_intact =
      libdeflate_crc32(0, begin + 4, num_bytes + 4) == BigEndian(begin + 8 + num_bytes);
  const Chunk chunk = {{begin + 4, 4}, {begin + 8, num_bytes}, is_intact};
  if (!is_intact && chunk.IsNeeded()) return std::nullopt;
  *at += kNumOtherBytes + num_bytes;
  return chunk;
}

struct Header {
  int width = 0;
  int height = 0;
  int type = -1;  // of cv::Mat
};

// OpenCV's type of an image; -1 for kinds that are left to other decoders.
int MatType(int num_bits, int color) {
  constexpr int kGray = 0, kRgb = 2, kRgba = 6;
  if (num_bits == 16) return color == kGray ? CV_16UC1 : -1;
  if (num_bits != 8) return -1;
  return color == kGray ? CV_8UC1 : color == kRgb ? CV_8UC3 : color == kRgba ? CV_8UC4 : -1;
}

std::optional<Header> ReadHeader(const Chunk& chunk) {
  if (chunk.type != "IHDR" || chunk.data.size() != 13) return std::nullopt;
  const char* const data = chunk.data.data();
  const bool is_simple = data[10] == 0 && data[11] == 0 && data[12] == 0;  // not interlaced
  const Header header = {static_cast<int>(BigEndian(data)), static_cast<int>(BigEndian(data + 4)),
                         MatType(data[8], data[9])};
  if (!is_simple || header.type < 0) return std::nullopt;
  return header;
}

// The compressed data of all chunks up to the end of the image; empty if something is missing or
// changes the meaning of the pixels.
std::string ReadData(const std::string& bytes, size_t at) {
  std::string data;
  while (const std::optional<Chunk> chunk = NextChunk(bytes, &at)) {
    if (chunk->type == "IEND") return data;
    const bool is_data = chunk->type == "IDAT";
    if ((chunk->IsNeeded() && !is_data) || chunk->type == "tRNS") return "";
    if (is_data) data.append(chunk->data);
  }
  return "";
}

// Rows of filter type and bytes.
std::unique_ptr<uint8_t[]> Inflate(const std::string& data, size_t num_bytes) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (inflater == nullptr) throw std::bad_alloc();
  std::unique_ptr<uint8_t[]> rows(new uint8_t[num_bytes]);
  if (libdeflate_zlib_decompress(inflater.get(), data.data(), data.size(), rows.get(), num_bytes,
                                 nullptr) != LIBDEFLATE_SUCCESS) {
    rows.reset();
  }
  return rows;
}

// Swaps the bytes of 16-bit values, or red and blue.
void WriteRow(const uint8_t* row, int width, int type, uint8_t* out) {
  switch (type) {
    case CV_16UC1:
      for (int i = 0; i < width; ++i) {
        reinterpret_cast<uint16_t*>(out)[i] =
            static_cast<uint16_t>(row[2 * i] << 8 | row[2 * i + 1]);
      }
      break;
    case CV_8UC3:
      for (int i = 0; i < 3 * width; i += 3) {
        out[i] = row[i + 2];
        out[i + 1] = row[i + 1];
        out[i + 2] = row[i];
      }
      break;
    case CV_8UC4:
      for (int i = 0; i < 4 * width; i += 4) {
        out[i] = row[i + 2];
        out[i + 1] = row[i + 1];
        out[i + 2] = row[i];
        out[i + 3] = row[i + 3];
      }
      break;
    default:
      std::copy(row, row + width, out);
  }
}

constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";

}  // namespace

bool IsPng(const std::string& bytes) {
  return bytes.compare(0, kSignature.size(), kSignature) == 0;
}

std::string EssentialPng(const std::string& bytes) {
  size_t at = kSignature.size();
  std::string essential(kSignature);
  for (size_t begin = at; const std::optional<Chunk> chunk = NextChunk(bytes, &at); begin = at) {
    const bool is_kept = chunk->IsNeeded() || (chunk->type == "tRNS" && chunk->is_intact);
    if (is_kept) essential.append(bytes, begin, at - begin);
    if (chunk->type == "IEND") return essential;
  }
  return "";
}

cv::Mat DecodePng(const std::string& bytes) {
  size_t at = kSignature.size();
  if (!IsPng(bytes)) return {};
  const std::optional<Chunk> first = NextChunk(bytes, &at);
  const std::optional<Header> header = first ? ReadHeader(*first) : std::nullopt;
  if (!header || !IsPlausibleSize({header->width, header->height}, bytes.size())) return {};
  const int pixel_bytes = static_cast<int>(CV_ELEM_SIZE(header->type));
  const size_t row_bytes = static_cast<size_t>(header->width) * pixel_bytes;
  const std::string data = ReadData(bytes, at);
  const std::unique_ptr<uint8_t[]> rows = Inflate(data, (row_bytes + 1) * header->height);
  if (!rows || !UndoPngFilters(pixel_bytes, row_bytes, header->height, rows.get())) return {};
  cv::Mat image(header->height, header->width, header->type);
  for (int i = 0; i < image.rows; ++i) {
    WriteRow(rows.get() + i * (row_bytes + 1) + 1, image.cols, header->type, image.ptr(i));
  }
  return image;
}

}  // namespace msc_vo
