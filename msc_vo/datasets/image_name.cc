// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_name.h"

#include <cmath>
#include <filesystem>

#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Returns the end of the run of digits that starts at `begin`.
size_t EndOfDigits(const std::string& text, size_t begin) {
  while (begin < text.size() && IsDigit(text[begin])) ++begin;
  return begin;
}

// Returns the run of digits without leading zeros, so that the longer number is the larger one.
std::string SignificantDigits(const std::string& text, size_t begin, size_t end) {
  while (begin + 1 < end && text[begin] == '0') ++begin;
  return text.substr(begin, end - begin);
}

}  // namespace

bool NaturalLess(const std::string& a, const std::string& b) {
  size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const size_t end_i = EndOfDigits(a, i);
      const size_t end_j = EndOfDigits(b, j);
      const std::string number_a = SignificantDigits(a, i, end_i);
      const std::string number_b = SignificantDigits(b, j, end_j);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      i = end_i;
      j = end_j;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  const size_t left_a = a.size() - i;
  const size_t left_b = b.size() - j;
  return left_a != left_b ? left_a < left_b : a < b;  // "01" and "1" need some fixed order
}

std::optional<int64_t> FrameNumber(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  size_t end = stem.size();
  while (end > 0 && !IsDigit(stem[end - 1])) --end;
  size_t begin = end;
  while (begin > 0 && IsDigit(stem[begin - 1])) --begin;
  constexpr size_t kMaxDigits = 18;  // fits int64_t
  if (begin == end || end - begin > kMaxDigits) return std::nullopt;
  return std::stoll(stem.substr(begin, end - begin));
}

std::optional<double> StampFromName(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  constexpr size_t kNanosecondDigits = 16;  // more than any frame number, fewer than any date
  const std::optional<double> value = ParseNumber(stem);
  if (value && std::isfinite(*value)) {
    if (stem.find('.') != std::string::npos) return value;
    if (const auto unit = UnitOfDate(*value)) return *value / UnitsPerSecond(*unit);
    if (stem.size() >= kNanosecondDigits) return 1e-9 * *value;
  }
  const std::optional<int64_t> number = FrameNumber(path);
  if (!number) return std::nullopt;
  return static_cast<double>(*number) / kDefaultFrameRate;
}

}  // namespace msc_vo
