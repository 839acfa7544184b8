// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_name.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace msc_vo {

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

// Whether names of equal length differ in hexadecimal digits only, without the ending.
bool AreHexadecimal(const std::vector<std::string>& names) {
  if (names.empty()) return false;
  const std::string& first = names.front();
  size_t common = std::min(first.rfind('.'), first.size());
  const size_t end = common;
  for (const std::string& name : names) {
    if (name.size() != first.size()) return false;
    const auto differs = std::mismatch(first.begin(), first.begin() + common, name.begin()).first;
    common = static_cast<size_t>(differs - first.begin());
  }
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return std::all_of(name.begin() + common, name.begin() + end,
                       [](unsigned char c) { return std::isxdigit(c) != 0; });
  });
}

}  // namespace

std::string StemOf(const std::string& path) { return std::filesystem::path(path).stem().string(); }

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

void SortNames(std::vector<std::string>* names) {
  if (AreHexadecimal(*names)) {
    std::sort(names->begin(), names->end());
  } else {
    std::sort(names->begin(), names->end(), NaturalLess);
  }
}

NameParts SplitName(const std::string& stem) {
  NameParts parts;
  for (size_t at = 0;;) {
    size_t begin = at;
    while (begin < stem.size() && !IsDigit(stem[begin])) ++begin;
    parts.texts.push_back(stem.substr(at, begin - at));
    if (begin == stem.size()) return parts;
    at = EndOfDigits(stem, begin);
    parts.digits.push_back(stem.substr(begin, at - begin));
  }
}

}  // namespace msc_vo
