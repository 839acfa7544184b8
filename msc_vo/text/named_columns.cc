// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/named_columns.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace msc_vo {

NamedColumns::NamedColumns(const std::string& path, const ColumnFixes& fixes)
    : lines_(ReadTextLines(path)), fixes_(fixes) {
  if (lines_.empty()) throw std::runtime_error(path + ":1: the file is empty; " + fixes_.damage);
  const std::vector<std::string>& names = lines_.front().fields;
  for (size_t i = 0; i < names.size(); ++i) columns_.emplace(Lowercase(names[i]), i);
}

size_t NamedColumns::Column(const std::string& name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) {
    lines_.front().Fail("no column '" + name + "'; " + fixes_.missing_column);
  }
  return found->second;
}

double NamedColumns::Number(size_t row, size_t column) const {
  const std::vector<std::string>& names = lines_.front().fields;
  const std::vector<std::string>& fields = lines_[row + 1].fields;
  if (fields.size() != names.size()) {
    Fail(row, std::to_string(names.size()) + " columns expected as in the first line, found " +
                  std::to_string(fields.size()));
  }
  const std::optional<double> number = ParseNumber(fields[column]);
  if (!number || !std::isfinite(*number)) {
    Fail(row, "'" + fields[column] + "' in the column " + names[column] + " is no finite number");
  }
  return *number;
}

void NamedColumns::Fail(size_t row, const std::string& problem) const {
  lines_[row + 1].Fail(problem + "; " + fixes_.damage);
}

}  // namespace msc_vo
