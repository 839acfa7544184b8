// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace msc_vo {

/// Throws std::runtime_error that names a file which is damaged, the problem and the fix.
[[noreturn]] void RefuseDamaged(const std::string& path, std::string problem);

/// The application id in the header of a regular file of SQLite; std::nullopt if it is none.
std::optional<uint32_t> ApplicationIdOf(const std::string& path);

/// A statement of SQL that is executed once or several times. Columns and parameters count from 0.
/// All functions throw as SqliteDatabase does. The database must outlive it.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::string& path, const std::string& sql);

  void BindNull(int parameter);
  void Bind(int parameter, int64_t value);
  void Bind(int parameter, double value);
  void BindText(int parameter, std::string_view text);
  /// `bytes` must live until the next Step().
  void BindBlob(int parameter, std::string_view bytes);

  /// Executes the statement up to its next row; returns false without one, and makes it ready to be
  /// executed again.
  bool Step();

  /// SQLITE_INTEGER, SQLITE_FLOAT and so on.
  int Type(int column) const;
  int64_t Integer(int column) const;
  double Real(int column) const;
  /// Of a text or a blob, valid until the next Step().
  std::string_view Bytes(int column) const;

 private:
  void Check(int result) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::string path_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A connection to an SQLite file. All functions throw std::runtime_error that names the file, the
/// problem and the fix, and WriteError if the file cannot be written.
class SqliteDatabase {
 public:
  enum class Access {
    kRead,   ///< the file must exist
    kWrite,  ///< it is created if it does not exist; no other process can use it until the end
  };
  SqliteDatabase(const std::string& path, Access access);

  const std::string& path() const { return path_; }
  SqliteStatement Prepare(const std::string& sql) const { return {database_.get(), path_, sql}; }
  void Execute(const std::string& sql) const;
  /// The first column of the first row.
  int64_t Integer(const std::string& sql) const;

  /// Calls `write` in one transaction, which is rolled back if it throws.
  template <typename Write>
  void Transaction(const Write& write) const {
    RefuseIfMoved();
    Execute("BEGIN IMMEDIATE");
    try {
      write();
      Execute("COMMIT");
    } catch (...) {
      RollBack();
      throw;
    }
  }

 private:
  void RefusePartOfAPage() const;
  void RefuseIfMoved() const;
  void RollBack() const;

  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::string path_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace msc_vo
