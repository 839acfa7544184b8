// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/text_record.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace msc_vo {

void FieldWriter::Number(const char*, double value) { *text_ += ' ' + FormatNumber(value); }

void FieldWriter::Integer(const char*, int64_t value) { *text_ += ' ' + std::to_string(value); }

void FieldWriter::Flag(const char* if_false, const char* if_true, bool value) {
  *text_ += ' ';
  *text_ += value ? if_true : if_false;
}

void FieldNames::Flag(const char* if_false, const char* if_true, bool) {
  Add(std::string(if_false) + "|" + if_true);
}

void FieldNames::Add(const std::string& name) { text_ += (text_.empty() ? "" : " ") + name; }

void FieldReader::Number(const char* name, double& value) {
  const std::string& field = Next();
  const std::optional<double> number = ParseNumber(field);
  if (!number || !std::isfinite(*number)) Fail(field, name + std::string(", a finite number"));
  value = *number;
}

void FieldReader::OptionalNumber(const char* name, double& value) {
  if (next_ < line_.fields.size()) Number(name, value);
}

void FieldReader::Integer(const char* name, int64_t& value) {
  using Limits = std::numeric_limits<int64_t>;
  value = ReadInteger(name, Limits::min(), Limits::max());
}

void FieldReader::Integer(const char* name, int& value) {
  using Limits = std::numeric_limits<int>;
  value = static_cast<int>(ReadInteger(name, Limits::min(), Limits::max()));
}

void FieldReader::Flag(const char* if_false, const char* if_true, bool& value) {
  const std::string& field = Next();
  value = field == if_true;
  if (!value && field != if_false) {
    Fail(field, std::string("'") + if_false + "' or '" + if_true + "'");
  }
}

void FieldReader::OptionalFlag(const char* if_true, bool& value) {
  value = next_ < line_.fields.size();
  if (!value) return;
  const std::string& field = Next();
  if (field != if_true) Fail(field, std::string("'") + if_true + "' or left out");
}

void FieldReader::EndRecord() const {
  if (next_ != line_.fields.size()) FailFieldCount();
}

const std::string& FieldReader::Next() {
  if (next_ >= line_.fields.size()) FailFieldCount();
  return line_.fields[next_++];
}

int64_t FieldReader::ReadInteger(const char* name, int64_t min, int64_t max) {
  const std::string& field = Next();
  const char* const end = field.data() + field.size();
  int64_t value = 0;
  const std::from_chars_result result = std::from_chars(field.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value < min || value > max) {
    Fail(field, name + std::string(", a whole number from ") + std::to_string(min) + " to " +
                    std::to_string(max));
  }
  return value;
}

void FieldReader::FailFieldCount() const {
  line_.Fail("expected '" + line_.fields.front() + " " + names_ + "', found " +
             std::to_string(line_.fields.size() - 1) + " fields after '" + line_.fields.front() +
             "'; correct the line");
}

void FieldReader::Fail(const std::string& field, const std::string& expected) const {
  line_.Fail("'" + field + "' should be " + expected + "; correct the line to '" +
             line_.fields.front() + " " + names_ + "'");
}

}  // namespace msc_vo
