// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/text/files.h"

namespace msc_vo {

/// A line of a text file that is neither blank nor a comment.
struct TextLine {
  std::string file;
  int number = 0;                   ///< line number, from 1
  std::vector<std::string> fields;  ///< see SplitFields()
  /// Text of the comment on the line directly above, trimmed and without '#'; empty if there is
  /// none.
  std::string comment;
  bool has_delimiters = false;  ///< commas or semicolons between the fields

  /// Returns the position for error messages, "file:12".
  std::string Where() const;
  /// Throws std::runtime_error "file:12: problem".
  [[noreturn]] void Fail(const std::string& problem) const;
  /// Tests whether a field is a number; a header has none.
  bool HasNumber() const;
};

/// Returns the contents of a text file without a UTF-8 byte order mark. The line ends CRLF remain;
/// CR alone becomes LF. Throws std::runtime_error as ReadFile() does, and if the text is UTF-16 or
/// UTF-32.
std::string ReadText(const std::string& path, std::uintmax_t max_bytes = kMaxTextBytes);

/// Splits a line at blanks and tabs, and at commas or, if there are semicolons, at these. Nothing
/// between two commas is an empty field, except at the end of the line.
std::vector<std::string> SplitFields(const std::string& text);

/// Reads the lines of a file that are neither blank nor a comment (#). Throws std::runtime_error as
/// ReadText() does.
std::vector<TextLine> ReadTextLines(const std::string& path);

/// Tests for a letter or digit of ASCII.
constexpr bool IsLetterOrDigit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}
/// Returns `text` in lower case; changes only the letters of ASCII.
std::string Lowercase(std::string text);
/// Returns the words with `separator` between them; none follows empty words at the beginning.
std::string Joined(const std::vector<std::string>& words, const std::string& separator);
/// Returns `text` without leading and trailing blanks, tabs and line ends.
std::string Trimmed(const std::string& text);
/// Parses `text` as a number, independent of the locale; none unless all of it is one number.
/// Accepts "nan" and "inf".
std::optional<double> ParseNumber(const std::string& text);
/// Returns the value as an int; none if it is not a whole number or does not fit.
std::optional<int> WholeNumber(double value);
/// Returns the shortest text that ParseNumber() converts to exactly the same number, including
/// "nan" and "inf".
std::string FormatNumber(double value);
/// Returns all fields of the line as finite numbers. Throws std::runtime_error naming file, line
/// and field.
std::vector<double> ParseNumbers(const TextLine& line);

}  // namespace msc_vo
