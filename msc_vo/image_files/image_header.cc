// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/image_header.h"

#include <cstdint>
#include <cstdlib>
#include <limits>

namespace msc_vo {

namespace {

enum class ByteOrder { kBig, kLittle };

// Numbers at positions of a file; none beyond its end.
class Bytes {
 public:
  explicit Bytes(const std::string& bytes) : bytes_(bytes) {}

  bool StartWith(const std::string& magic) const { return bytes_.rfind(magic, 0) == 0; }
  bool Have(size_t at, const std::string& text) const {
    return at <= bytes_.size() && bytes_.compare(at, text.size(), text) == 0;
  }

  // The number of `count` bytes, at most four.
  std::optional<uint32_t> Number(size_t at, size_t count, ByteOrder order) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return std::nullopt;
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) {
      const size_t place = order == ByteOrder::kBig ? i : count - 1 - i;
      value = value << 8 | static_cast<uint8_t>(bytes_[at + place]);
    }
    return value;
  }

 private:
  const std::string& bytes_;
};

std::optional<ImageSize> MakeSize(std::optional<uint32_t> width, std::optional<uint32_t> height) {
  constexpr uint32_t kLargest = std::numeric_limits<int32_t>::max();
  if (!width || !height || *width > kLargest || *height > kLargest) return std::nullopt;
  return ImageSize{static_cast<int>(*width), static_cast<int>(*height)};
}

std::optional<ImageSize> PngSize(const Bytes& bytes) {
  if (!bytes.Have(12, "IHDR")) return std::nullopt;
  return MakeSize(bytes.Number(16, 4, ByteOrder::kBig), bytes.Number(20, 4, ByteOrder::kBig));
}

bool IsFrameHeader(uint32_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool IsScanHeader(uint32_t marker) { return marker == 0xDA; }

// The position of the first marker of a kind, not after the first scan. Segments of any length,
// which may hold a whole preview, are skipped.
std::optional<size_t> FindJpegMarker(const Bytes& bytes, bool (*is_searched)(uint32_t)) {
  size_t at = 2;
  while (true) {
    const auto fill = bytes.Number(at, 1, ByteOrder::kBig);
    const auto marker = bytes.Number(at + 1, 1, ByteOrder::kBig);
    if (!fill || *fill != 0xFF || !marker) return std::nullopt;
    if (*marker == 0xFF) {
      ++at;
      continue;
    }
    if (*marker == 0x01 || (*marker >= 0xD0 && *marker <= 0xD7)) {  // without a length
      at += 2;
      continue;
    }
    if (is_searched(*marker)) return at;
    const auto length = bytes.Number(at + 2, 2, ByteOrder::kBig);
    if (!length || *length < 2) return std::nullopt;
    at += 2 + *length;
  }
}

std::optional<ImageSize> JpegSize(const Bytes& bytes) {
  const std::optional<size_t> at = FindJpegMarker(bytes, IsFrameHeader);
  if (!at) return std::nullopt;
  return MakeSize(bytes.Number(*at + 7, 2, ByteOrder::kBig),
                  bytes.Number(*at + 5, 2, ByteOrder::kBig));
}

std::optional<ImageSize> BmpSize(const Bytes& bytes) {
  const auto header_bytes = bytes.Number(14, 4, ByteOrder::kLittle);
  if (!header_bytes) return std::nullopt;
  if (*header_bytes == 12) {  // of OS/2
    return MakeSize(bytes.Number(18, 2, ByteOrder::kLittle),
                    bytes.Number(20, 2, ByteOrder::kLittle));
  }
  auto height = bytes.Number(22, 4, ByteOrder::kLittle);
  if (height && *height > 0x80000000u) height = 0u - *height;  // negative: from top to bottom
  return MakeSize(bytes.Number(18, 4, ByteOrder::kLittle), height);
}

std::optional<ByteOrder> TiffOrder(const Bytes& bytes) {
  if (bytes.StartWith(std::string("II*\0", 4))) return ByteOrder::kLittle;
  if (bytes.StartWith(std::string("MM\0*", 4))) return ByteOrder::kBig;
  return std::nullopt;
}

// The value of an entry of the first directory.
std::optional<uint32_t> TiffEntry(uint32_t tag, const Bytes& bytes, ByteOrder order) {
  const auto directory = bytes.Number(4, 4, order);
  const auto num_entries = directory ? bytes.Number(*directory, 2, order) : std::nullopt;
  constexpr uint32_t kShort = 3;
  for (size_t i = 0; i < num_entries.value_or(0); ++i) {
    const size_t at = size_t{*directory} + 2 + 12 * i;
    if (bytes.Number(at, 2, order) != tag) continue;
    if (bytes.Number(at + 4, 4, order) != 1u) return std::nullopt;  // several values, elsewhere
    return bytes.Number(at + 8, bytes.Number(at + 2, 2, order) == kShort ? 2 : 4, order);
  }
  return std::nullopt;
}

std::optional<ImageSize> TiffSize(const Bytes& bytes, ByteOrder order) {
  constexpr uint32_t kWidthTag = 256, kHeightTag = 257;
  return MakeSize(TiffEntry(kWidthTag, bytes, order), TiffEntry(kHeightTag, bytes, order));
}

std::optional<ImageSize> WebpSize(const Bytes& bytes) {
  constexpr uint32_t kFourteenBits = 0x3FFF;
  const auto number = [&bytes](size_t at, size_t count) {
    return bytes.Number(at, count, ByteOrder::kLittle);
  };
  if (bytes.Have(12, "VP8X")) {
    const auto width = number(24, 3), height = number(27, 3);
    if (!width || !height) return std::nullopt;
    return MakeSize(*width + 1, *height + 1);
  }
  if (bytes.Have(12, "VP8L")) {
    const auto sides = number(21, 4);
    if (!sides) return std::nullopt;
    return MakeSize((*sides & kFourteenBits) + 1, (*sides >> 14 & kFourteenBits) + 1);
  }
  if (!bytes.Have(12, "VP8 ")) return std::nullopt;
  const auto width = number(26, 2), height = number(28, 2);
  if (!width || !height) return std::nullopt;
  return MakeSize(*width & kFourteenBits, *height & kFourteenBits);
}

// Attributes, each a name and a type that end with 0, a size and a value, until an empty name. The
// size of the image follows from the attribute dataWindow.
std::optional<ImageSize> ExrSize(const std::string& bytes) {
  constexpr size_t kMaxAttributes = 1000;
  const Bytes file(bytes);
  size_t at = 8;
  for (size_t i = 0; i < kMaxAttributes; ++i) {
    const size_t name_end = bytes.find('\0', at);
    if (name_end == std::string::npos || name_end == at) return std::nullopt;
    const size_t type_end = bytes.find('\0', name_end + 1);
    if (type_end == std::string::npos) return std::nullopt;
    const auto size = file.Number(type_end + 1, 4, ByteOrder::kLittle);
    if (!size) return std::nullopt;
    const size_t value = type_end + 5;
    if (bytes.compare(at, name_end - at, "dataWindow") != 0) {
      at = value + *size;
      if (at >= bytes.size()) return std::nullopt;
      continue;
    }
    std::optional<uint32_t> ends[4];
    for (size_t k = 0; k < 4; ++k) ends[k] = file.Number(value + 4 * k, 4, ByteOrder::kLittle);
    if (!ends[0] || !ends[1] || !ends[2] || !ends[3]) return std::nullopt;
    return MakeSize(*ends[2] - *ends[0] + 1, *ends[3] - *ends[1] + 1);
  }
  return std::nullopt;
}

// "P5", then width and height between blanks and comments.
std::optional<ImageSize> PnmSize(const std::string& bytes) {
  uint32_t sides[2] = {};
  size_t at = 2;
  for (uint32_t& side : sides) {
    constexpr char kBlanks[] = " \t\r\n\v\f";
    at = bytes.find_first_not_of(kBlanks, at);
    while (at != std::string::npos && bytes[at] == '#') {
      at = bytes.find_first_not_of(kBlanks, bytes.find('\n', at));
    }
    if (at == std::string::npos) return std::nullopt;
    const size_t end = bytes.find_first_not_of("0123456789", at);
    constexpr size_t kMaxDigits = 9;
    if (end == std::string::npos || end == at || end - at > kMaxDigits) return std::nullopt;
    side = static_cast<uint32_t>(std::stoul(bytes.substr(at, end - at)));
    at = end;
  }
  return MakeSize(sides[0], sides[1]);
}

}  // namespace

std::optional<ImageSize> SizeInHeader(const std::string& content) {
  const Bytes bytes(content);
  if (bytes.StartWith("\x89PNG\r\n\x1A\n")) return PngSize(bytes);
  if (bytes.StartWith("\xFF\xD8")) return JpegSize(bytes);
  if (bytes.StartWith("BM")) return BmpSize(bytes);
  if (const auto order = TiffOrder(bytes)) return TiffSize(bytes, *order);
  if (bytes.StartWith("\x76\x2F\x31\x01")) return ExrSize(content);
  if (bytes.StartWith("RIFF") && bytes.Have(8, "WEBP")) return WebpSize(bytes);
  if (bytes.StartWith("P") && content.find_first_of("123456", 1) == 1) return PnmSize(content);
  return std::nullopt;
}

bool IsTiffOfOtherNumbers(const std::string& content) {
  const Bytes bytes(content);
  const std::optional<ByteOrder> order = TiffOrder(bytes);
  if (!order) return false;
  constexpr uint32_t kBitsTag = 258, kFormatTag = 339, kUnsigned = 1, kFloat = 3;
  const uint32_t bits = TiffEntry(kBitsTag, bytes, *order).value_or(1);
  const uint32_t format = TiffEntry(kFormatTag, bytes, *order).value_or(kUnsigned);
  return (format == kUnsigned && bits == 32) || (format == kFloat && bits == 16);
}

bool IsTruncatedJpeg(const std::string& content) {
  const Bytes bytes(content);
  if (!bytes.StartWith("\xFF\xD8")) return false;
  const std::optional<size_t> scan = FindJpegMarker(bytes, IsScanHeader);
  return !scan || content.find("\xFF\xD9", *scan) == std::string::npos;
}

bool IsPlausibleSize(const ImageSize& size, size_t num_bytes) {
  constexpr int kMaxSide = 16384;  // of a camera, see PinholeCamera
  // Deflate, the strongest compression of these formats, shortens to 1/1032; a byte has 8 pixels of
  // a bit each. Images of a megapixel do no harm.
  constexpr uint64_t kMaxPixelsPerByte = 8 * 1032;
  constexpr uint64_t kHarmlessPixels = uint64_t{1} << 20;
  if (size.width < 1 || size.height < 1 || size.width > kMaxSide || size.height > kMaxSide) {
    return false;
  }
  const uint64_t num_pixels =
      static_cast<uint64_t>(size.width) * static_cast<uint64_t>(size.height);
  return num_pixels <= kHarmlessPixels + kMaxPixelsPerByte * num_bytes;
}

}  // namespace msc_vo
