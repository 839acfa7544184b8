// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/text/files.h"

namespace msc_vo {

// One line of a text file that carries data, with the place it came from.
struct TextLine {
  std::string file;
  int number = 0;                   // from 1
  std::vector<std::string> fields;  // separated by blanks, tabs or commas
  // Of the comment in the line right above, if that is one: without its '#' and blanks around it.
  std::string comment;

  std::string Where() const;  // "file:12"
};

// The lines of a file that are neither blank nor a comment (#); CRLF is understood.
// Throws std::runtime_error, naming the file, if it cannot be read.
std::vector<TextLine> ReadTextLines(const std::string& path);

// The number that all of `text` spells, whatever the locale; none if it spells none.
std::optional<double> ParseNumber(const std::string& text);
// The value as an int, if it is a whole number that fits.
std::optional<int> WholeNumber(double value);
// The shortest text that ParseNumber reads back to the very same number; "nan" and "inf" too.
std::string FormatNumber(double value);
// All fields of the line as finite numbers. Throws std::runtime_error naming file, line and field.
std::vector<double> ParseNumbers(const TextLine& line);

}  // namespace msc_vo
