// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/sqlite_database.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include "msc_vo/text/files.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {

namespace {

// Largest text or blob that is read: a hundred times what a keyframe takes.
constexpr int kMaxBytes = 16 << 20;

// The beginning of a file.
constexpr std::string_view kMagic("SQLite format 3", 16);

std::string Describe(sqlite3* database, int result) {
  const std::string text = sqlite3_errmsg(database);
  switch (result & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return "is in use by another run of msc_vo; wait until that has ended, or choose another "
             "file";
    case SQLITE_NOTADB:
      return "is no map of msc_vo (" + text + "); choose another file";
    default:
      return "cannot be used as a map (" + text +
             "); check the file, its folder and its permissions";
  }
}

std::string JournalOf(const std::string& path) { return path + "-journal"; }

// `cause`: errno of the call that has failed, if it is known.
[[noreturn]] void Fail(sqlite3* database, const std::string& path, int result, int cause = 0) {
  const bool is_of_journal = result == SQLITE_READONLY_ROLLBACK || result == SQLITE_IOERR_DELETE;
  if (is_of_journal && HasEntry(JournalOf(path))) {
    throw std::runtime_error(path + ": cannot be restored from " + JournalOf(path) +
                             ", which a run that was killed has left, without permission to write "
                             "both; copy both into a folder of your own");
  }
  switch (result) {
    case SQLITE_IOERR_WRITE:
    case SQLITE_IOERR_FSYNC:
    case SQLITE_IOERR_DIR_FSYNC:
    case SQLITE_IOERR_TRUNCATE:
    case SQLITE_IOERR_DELETE:
      throw WriteError(path, cause);
    default:
      break;
  }
  switch (result & 0xff) {
    case SQLITE_CORRUPT:
    case SQLITE_TOOBIG:
    case SQLITE_ERROR:
    case SQLITE_SCHEMA:
      RefuseDamaged(path, sqlite3_errmsg(database));
    case SQLITE_FULL:
      throw WriteError(path, ENOSPC);
    case SQLITE_READONLY:
      throw WriteError(path, EACCES);
    default:
      throw std::runtime_error(path + ": " + Describe(database, result));
  }
}

// SQLite would interpret some names, such as ":memory:" and "file:x?mode=memory", and keep the map
// in memory or in a temporary file; a path that begins with a slash is always the name of a file.
std::string NameForSqlite(const std::string& path) {
  if (path.empty()) throw std::runtime_error("the name of the map file is empty; give a name");
  if (path.find('\0') != std::string::npos) {
    throw std::runtime_error(
        path.substr(0, path.find('\0')) +
        ": a zero byte follows in the name of the map file; give another name");
  }
  return std::filesystem::absolute(path).string();
}

// Throws WriteError unless the file can be written, and its journal, which is beside it (beside the
// target of a link). SQLite would open the file for reading only.
void RefuseReadOnly(const std::string& path) {
  const auto check = [&path](const std::string& entry) {
    if (faccessat(AT_FDCWD, entry.c_str(), W_OK, AT_EACCESS) != 0) throw WriteError(path, errno);
  };
  std::error_code error;
  const std::filesystem::path target =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path), error);
  if (error) throw WriteError(path, error.value());
  check(target.parent_path().string());
  if (HasEntry(path)) check(path);
}

// SQLite takes a file that is shorter than a page for a new one, and would overwrite it.
void RefuseOtherFiles(const std::string& path) {
  const std::string problem = FileProblem(path, std::numeric_limits<std::uintmax_t>::max());
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
  constexpr size_t kSmallestPage = 512;
  std::string header(kSmallestPage, '\0');
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read (check its permissions)");
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<size_t>(file.gcount()));
  if (header.empty()) return;
  if (header.compare(0, kMagic.size(), kMagic) != 0) {
    throw std::runtime_error(path + ": is no map of msc_vo; choose another file");
  }
  if (header.size() < kSmallestPage) {
    RefuseDamaged(path, "truncated");
  }
}

}  // namespace

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement::SqliteStatement(sqlite3* database, const std::string& path, const std::string& sql)
    : database_(database), path_(path) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database, sql.c_str(), static_cast<int>(sql.size() + 1),
                                        &statement, nullptr);
  statement_.reset(statement);
  Check(result);
}

void SqliteStatement::Check(int result) const {
  if (result != SQLITE_OK) Fail(database_, path_, result);
}

void SqliteStatement::BindNull(int parameter) {
  Check(sqlite3_bind_null(statement_.get(), parameter + 1));
}

void SqliteStatement::Bind(int parameter, int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), parameter + 1, value));
}

void SqliteStatement::Bind(int parameter, double value) {
  Check(sqlite3_bind_double(statement_.get(), parameter + 1, value));
}

void SqliteStatement::BindText(int parameter, std::string_view text) {
  Check(sqlite3_bind_text(statement_.get(), parameter + 1, text.data(),
                          static_cast<int>(text.size()), SQLITE_TRANSIENT));
}

void SqliteStatement::BindBlob(int parameter, std::string_view bytes) {
  // Without a pointer, SQLite would store NULL instead of an empty blob.
  const char* data = bytes.empty() ? "" : bytes.data();
  Check(sqlite3_bind_blob64(statement_.get(), parameter + 1, data, bytes.size(), SQLITE_STATIC));
}

bool SqliteStatement::Step() {
  errno = 0;
  const int result = sqlite3_step(statement_.get());
  const int cause = errno;
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) {
    // The message of the failed step, which resetting repeats.
    sqlite3_reset(statement_.get());
    Fail(database_, path_, result, cause);
  }
  Check(sqlite3_reset(statement_.get()));
  return false;
}

int SqliteStatement::Type(int column) const {
  return sqlite3_column_type(statement_.get(), column);
}

int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::Real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string_view SqliteStatement::Bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data == nullptr ? std::string_view()
                         : std::string_view(static_cast<const char*>(data), size);
}

void RefuseDamaged(const std::string& path, std::string problem) {
  std::replace(problem.begin(), problem.end(), '\n', ' ');
  const std::string journal = JournalOf(std::filesystem::path(path).filename().string());
  throw std::runtime_error(path + ": is damaged (" + problem + "); restore a copy, without " +
                           journal + " of before, or record the map again");
}

std::optional<uint32_t> ApplicationIdOf(const std::string& path) {
  constexpr size_t kOffset = 68, kSize = 4;  // https://www.sqlite.org/fileformat.html
  std::error_code error;                     // a pipe would wait for its writer
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const std::string header = ReadBeginning(path, kOffset + kSize);
  if (header.size() < kOffset + kSize || header.compare(0, kMagic.size(), kMagic) != 0) {
    return std::nullopt;
  }
  uint32_t id = 0;
  for (size_t i = 0; i < kSize; ++i) id = id << 8 | static_cast<uint8_t>(header[kOffset + i]);
  return id;
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

// A reader, too, opens the file for writing if it may: a run that was killed may have left a
// journal from which its last state has to be restored.
SqliteDatabase::SqliteDatabase(const std::string& path, Access access) : path_(path) {
  const std::string name = NameForSqlite(path);
  if (access == Access::kRead || HasEntry(path)) RefuseOtherFiles(path);
  if (access == Access::kWrite) RefuseReadOnly(path);
  const int create = access == Access::kWrite ? SQLITE_OPEN_CREATE : 0;
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(name.c_str(), &database, SQLITE_OPEN_READWRITE | create, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) Fail(database, path, result);
  sqlite3_extended_result_codes(database, 1);
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kMaxBytes);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  // Nothing in a file of others is executed, and its pages are checked before they are used.
  Execute("PRAGMA trusted_schema = OFF");
  Execute("PRAGMA cell_size_check = ON");
  if (access == Access::kRead) {
    RefusePartOfAPage();
    return;
  }
  // Of a new file: half the default, as the last page of each blob is half empty on average. An
  // image of 2000 bytes fits into one.
  Execute("PRAGMA page_size = 2048");
  // The lock is taken by the first transaction and kept until the connection is closed.
  Execute("PRAGMA locking_mode = EXCLUSIVE");
  Execute("PRAGMA synchronous = NORMAL");
  Execute("BEGIN EXCLUSIVE");
  Execute("COMMIT");
  RefusePartOfAPage();
}

void SqliteDatabase::Execute(const std::string& sql) const {
  SqliteStatement statement = Prepare(sql);
  while (statement.Step()) continue;
}

int64_t SqliteDatabase::Integer(const std::string& sql) const {
  SqliteStatement statement = Prepare(sql);
  const int64_t value = statement.Step() ? statement.Integer(0) : 0;
  return value;
}

// SQLite notices only whole pages that are missing.
void SqliteDatabase::RefusePartOfAPage() const {
  const auto page_size = static_cast<std::uintmax_t>(Integer("PRAGMA page_size"));
  Execute("PRAGMA page_count");  // restores the last state from a journal first
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path_, error);
  if (!error && size % page_size != 0) RefuseDamaged(path_, "truncated");
}

// SQLite checks it with the first transaction only, as the journal remains open.
void SqliteDatabase::RefuseIfMoved() const {
  int has_moved = 0;
  sqlite3_file_control(database_.get(), nullptr, SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (has_moved == 0) return;
  throw std::runtime_error(path_ +
                           ": cannot be written, because it has been moved, removed or replaced "
                           "since it was opened; leave it until the run has ended");
}

void SqliteDatabase::RollBack() const {
  // Fails if an error has ended the transaction already.
  if (sqlite3_get_autocommit(database_.get()) == 0) {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
  }
}

}  // namespace msc_vo
