// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/text_file.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msc_vo {

namespace {

std::vector<std::string> SplitFields(const std::string& text) {
  constexpr char kSeparators[] = " \t\r\n,";
  std::vector<std::string> fields;
  size_t begin = text.find_first_not_of(kSeparators);
  while (begin != std::string::npos) {
    const size_t end = text.find_first_of(kSeparators, begin);
    fields.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kSeparators, end);
  }
  return fields;
}

}  // namespace

std::string TextLine::Where() const { return file + ":" + std::to_string(number); }

void TextLine::Fail(const std::string& problem) const {
  throw std::runtime_error(Where() + ": " + problem);
}

std::vector<TextLine> ReadTextLines(const std::string& path) {
  std::istringstream content(ReadFile(path));
  std::vector<TextLine> lines;
  std::string text, comment;
  for (int number = 1; std::getline(content, text); ++number) {
    // Some editors on Windows write a byte order mark before the first line.
    if (number == 1 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    TextLine line{path, number, SplitFields(text), std::exchange(comment, "")};
    if (line.fields.empty()) continue;
    if (line.fields.front()[0] == '#') {
      comment = Trimmed(text.substr(text.find('#') + 1));
    } else {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

std::string Lowercase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string Trimmed(const std::string& text) {
  constexpr char kBlanks[] = " \t\r\n";
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::optional<double> ParseNumber(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;  // from_chars rejects a plus sign
  double value = 0.0;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return value;
}

std::optional<int> WholeNumber(double value) {
  constexpr double kLargest = std::numeric_limits<int>::max();
  if (!(std::abs(value) <= kLargest) || value != std::floor(value)) return std::nullopt;
  return static_cast<int>(value);
}

std::string FormatNumber(double value) {
  char buffer[40];  // the longest double has 24 characters
  return {buffer, std::to_chars(buffer, buffer + sizeof(buffer), value).ptr};
}

std::vector<double> ParseNumbers(const TextLine& line) {
  std::vector<double> values;
  for (const std::string& field : line.fields) {
    const std::optional<double> value = ParseNumber(field);
    if (!value || !std::isfinite(*value)) {
      line.Fail("'" + field + "' is not a finite number; correct or remove the line");
    }
    values.push_back(*value);
  }
  return values;
}

}  // namespace msc_vo
