// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>
#include <vector>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

/// What a user can do about a file with named columns; ends the messages. String literals.
struct ColumnFixes {
  const char* missing_column;
  const char* damage;  ///< any other problem
};

/// A text file whose first line names the columns of the rows below it. The case of names does not
/// count. All errors are std::runtime_error, name file and line and end with a fix.
class NamedColumns {
 public:
  /// Throws as ReadTextLines() does, and if the file is empty.
  NamedColumns(const std::string& path, const ColumnFixes& fixes);

  size_t num_rows() const { return lines_.size() - 1; }
  /// `name`: lower case.
  bool Has(const std::string& name) const { return columns_.count(name) > 0; }
  /// Returns the index of a column. Throws if there is none of this name.
  size_t Column(const std::string& name) const;
  /// Returns a field of row `row`, from 0. Throws if it is not a finite number, and if the row has
  /// another number of fields than the first line.
  double Number(size_t row, size_t column) const;
  /// Throws the message that something is wrong with a row.
  [[noreturn]] void Fail(size_t row, const std::string& problem) const;

 private:
  std::vector<TextLine> lines_;
  std::map<std::string, size_t> columns_;
  ColumnFixes fixes_;
};

}  // namespace msc_vo
