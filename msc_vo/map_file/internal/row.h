// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

/// Checksum of the values of a row (docs/map_file.md).
class RowChecksum {
 public:
  void AddNull() { AddByte('n'); }
  void Add(int64_t value);
  void Add(double value);
  void AddText(std::string_view text) { AddBytes('t', text); }
  void AddBlob(std::string_view bytes) { AddBytes('b', bytes); }

  int64_t value() const { return hash_; }

 private:
  void AddByte(uint8_t byte) { hash_ = (hash_ ^ byte) * 0x01000193; }
  void AddNumber(char kind, uint64_t bits);
  void AddBytes(char kind, std::string_view bytes);

  uint32_t hash_ = 0x811c9dc5;
};

/// Prepares the insertion of a row by RowWriter, which replaces the one with the same key.
/// `num_columns` counts the checksum.
SqliteStatement PrepareUpsert(const SqliteDatabase& database, const std::string& table,
                              int num_columns);

/// Binds the values of a row from left to right, and a checksum of them as the last one.
class RowWriter {
 public:
  explicit RowWriter(SqliteStatement* statement) : statement_(statement) {}

  RowWriter& Null();
  RowWriter& Integer(int64_t value);
  /// Throws std::invalid_argument if the value is not finite, which SQLite cannot store.
  RowWriter& Real(double value);
  /// Metres, stored as an integer in micrometres.
  RowWriter& Metres(double value);
  RowWriter& Text(std::string_view text);
  /// `bytes` must live until Execute().
  RowWriter& Blob(std::string_view bytes);
  void Execute();

 private:
  SqliteStatement* statement_;
  RowChecksum checksum_;
  int column_ = 0;
};

/// Reads the values of a row from left to right. A value of another type, and a checksum that does
/// not fit, throw std::runtime_error.
class RowReader {
 public:
  /// `path` and `table` are those of error messages; all must outlive the reader.
  RowReader(const SqliteStatement& statement, const std::string& path, const char* table)
      : statement_(statement), path_(path), table_(table) {}

  bool IsNull();  ///< consumes the value if it is null
  int64_t Integer();
  double Real();
  double Metres();
  std::string_view Text();
  std::string_view Blob();
  /// Call after the last value.
  void Finish();

  /// Throws the error that `problem` is in this row.
  [[noreturn]] void Fail(const std::string& problem) const;

 private:
  int Next(int type);

  const SqliteStatement& statement_;
  const std::string& path_;
  const char* table_;
  RowChecksum checksum_;
  int column_ = 0;
};

/// Calls `read` for every row of a table, by ascending `key`. A BlobError that it throws becomes
/// the error that the row is damaged.
void ForEachRow(const SqliteDatabase& database, const char* table, const char* key,
                const std::function<void(RowReader*)>& read);

}  // namespace msc_vo
