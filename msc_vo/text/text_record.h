// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

// A record is a line of text: a keyword, then fields in a fixed order. One function describes the
// fields of a record by passing each to a visitor, which writes, reads or names them:
//
//   template <typename Point, typename Fields>
//   void Visit(Point& point, Fields& fields) {
//     fields.Integer("ID", point.id);
//     fields.Number("X", point.x);
//     fields.Flag("free", "fixed", point.fixed);
//   }

/// Writes the keyword and the fields of a record.
class FieldWriter {
 public:
  FieldWriter(const char* keyword, std::string* text) : text_(text) { *text_ += keyword; }

  void Number(const char* name, double value);
  void OptionalNumber(const char* name, double value) { Number(name, value); }
  void Integer(const char* name, int64_t value);
  void Flag(const char* if_false, const char* if_true, bool value);
  void OptionalFlag(const char* if_true, bool value) {
    if (value) Flag("", if_true, value);
  }
  void EndRecord() { *text_ += '\n'; }

 private:
  std::string* text_;
};

/// Lists the names of the fields: "ID X free|fixed"; optional fields are in brackets.
class FieldNames {
 public:
  void Number(const char* name, double) { Add(name); }
  void OptionalNumber(const char* name, double) { Add(std::string("[") + name + "]"); }
  void Integer(const char* name, int64_t) { Add(name); }
  void Flag(const char* if_false, const char* if_true, bool);
  void OptionalFlag(const char* if_true, bool) { Add(std::string("[") + if_true + "]"); }

  const std::string& text() const { return text_; }

 private:
  void Add(const std::string& name);

  std::string text_;
};

/// Reads the fields after the keyword. Every member throws std::runtime_error naming file, line,
/// field and fix.
class FieldReader {
 public:
  /// `names` is the text of FieldNames, for error messages. `line` must outlive the reader.
  FieldReader(const TextLine& line, std::string names) : line_(line), names_(std::move(names)) {}

  void Number(const char* name, double& value);
  /// Allowed only at the end of a record. If the field is missing, `value` is not changed.
  void OptionalNumber(const char* name, double& value);
  void Integer(const char* name, int64_t& value);
  void Integer(const char* name, int& value);
  void Flag(const char* if_false, const char* if_true, bool& value);
  /// Allowed only at the end of a record. A missing field is false.
  void OptionalFlag(const char* if_true, bool& value);
  /// Checks that no field is left; to be called after the last field.
  void EndRecord() const;

 private:
  const std::string& Next();
  int64_t ReadInteger(const char* name, int64_t min, int64_t max);
  [[noreturn]] void FailFieldCount() const;
  [[noreturn]] void Fail(const std::string& field, const std::string& expected) const;

  const TextLine& line_;
  std::string names_;
  size_t next_ = 1;  // the field after the keyword
};

}  // namespace msc_vo
