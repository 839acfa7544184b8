// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/text_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msc_vo {

namespace {

constexpr char kBlanks[] = " \t\r\n";

// Appends the words between blanks, or an empty one if there are none.
void AppendWords(const std::string& text, std::vector<std::string>* words) {
  size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string::npos) words->emplace_back();
  while (begin != std::string::npos) {
    const size_t end = text.find_first_of(kBlanks, begin);
    words->push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlanks, end);
  }
}

// Tests whether the text has units of two or four bytes. Text begins with a byte order mark or an
// ASCII character, whose other bytes are zero.
bool IsWideText(const std::string& content) {
  if (content.size() < 2) return false;
  const std::string mark = content.substr(0, 2);
  return mark == "\xFF\xFE" || mark == "\xFE\xFF" || (content[0] == '\0') != (content[1] == '\0') ||
         content.compare(0, 4, std::string("\0\0\xFE\xFF", 4)) == 0;
}

}  // namespace

std::string TextLine::Where() const { return file + ":" + std::to_string(number); }

void TextLine::Fail(const std::string& problem) const {
  std::string message = Where() + ": " + problem;
  std::replace(message.begin(), message.end(), '\0', '?');  // what() would end there
  throw std::runtime_error(message);
}

bool TextLine::HasNumber() const {
  return std::any_of(fields.begin(), fields.end(),
                     [](const std::string& field) { return ParseNumber(field).has_value(); });
}

std::string ReadText(const std::string& path, std::uintmax_t max_bytes) {
  std::string content = ReadFile(path, max_bytes);
  if (IsWideText(content)) {
    throw std::runtime_error(path + ": is UTF-16 or UTF-32 text; save it as UTF-8");
  }
  if (content.rfind("\xEF\xBB\xBF", 0) == 0) content.erase(0, 3);
  if (content.find('\n') == std::string::npos) {
    std::replace(content.begin(), content.end(), '\r', '\n');
  }
  return content;
}

std::vector<std::string> SplitFields(const std::string& text) {
  const char delimiter = text.find(';') != std::string::npos ? ';' : ',';
  std::vector<std::string> fields;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(delimiter, begin), text.size());
    AppendWords(text.substr(begin, end - begin), &fields);
    begin = end + 1;
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::vector<TextLine> ReadTextLines(const std::string& path) {
  std::istringstream content(ReadText(path));
  std::vector<TextLine> lines;
  std::string text, comment;
  for (int number = 1; std::getline(content, text); ++number) {
    TextLine line{path, number, SplitFields(text), std::exchange(comment, ""),
                  text.find_first_of(",;") != std::string::npos};
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

std::string Joined(const std::vector<std::string>& words, const std::string& separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string Trimmed(const std::string& text) {
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
