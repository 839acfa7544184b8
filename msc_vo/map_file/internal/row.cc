// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/row.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

#include <sqlite3.h>

#include "msc_vo/map_file/internal/blob.h"

namespace msc_vo {

namespace {

constexpr double kMicrometres = 1e6;      // per metre
constexpr double kMaxMicrometres = 1e15;  // a million kilometres

}  // namespace

void RowChecksum::AddNumber(char kind, uint64_t bits) {
  AddByte(kind);
  for (int i = 0; i < 8; ++i) AddByte(static_cast<uint8_t>(bits >> (8 * i)));
}

void RowChecksum::Add(int64_t value) { AddNumber('i', static_cast<uint64_t>(value)); }

void RowChecksum::Add(double value) {
  uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  AddNumber('r', bits);
}

void RowChecksum::AddBytes(char kind, std::string_view bytes) {
  AddNumber(kind, bytes.size());
  for (const char byte : bytes) AddByte(static_cast<uint8_t>(byte));
}

SqliteStatement PrepareUpsert(const SqliteDatabase& database, const std::string& table,
                              int num_columns) {
  std::string sql = "INSERT OR REPLACE INTO " + table + " VALUES (?";
  for (int i = 1; i < num_columns; ++i) sql += ", ?";
  return database.Prepare(sql + ")");
}

RowWriter& RowWriter::Null() {
  checksum_.AddNull();
  statement_->BindNull(column_++);
  return *this;
}

RowWriter& RowWriter::Integer(int64_t value) {
  checksum_.Add(value);
  statement_->Bind(column_++, value);
  return *this;
}

RowWriter& RowWriter::Real(double value) {
  if (!std::isfinite(value)) throw std::invalid_argument("map file: a value is not finite");
  value += 0.0;  // SQLite stores no negative zero
  checksum_.Add(value);
  statement_->Bind(column_++, value);
  return *this;
}

RowWriter& RowWriter::Metres(double value) {
  const double micrometres = std::round(kMicrometres * value);
  if (!(std::abs(micrometres) <= kMaxMicrometres)) {
    throw std::invalid_argument("map file: a position is too far away to be stored");
  }
  return Integer(static_cast<int64_t>(micrometres));
}

RowWriter& RowWriter::Text(std::string_view text) {
  checksum_.AddText(text);
  statement_->BindText(column_++, text);
  return *this;
}

RowWriter& RowWriter::Blob(std::string_view bytes) {
  checksum_.AddBlob(bytes);
  statement_->BindBlob(column_++, bytes);
  return *this;
}

void RowWriter::Execute() {
  statement_->Bind(column_, checksum_.value());
  statement_->Step();
}

int RowReader::Next(int type) {
  if (statement_.Type(column_) != type) Fail("column " + std::to_string(column_) + " is not valid");
  return column_++;
}

bool RowReader::IsNull() {
  if (statement_.Type(column_) != SQLITE_NULL) return false;
  checksum_.AddNull();
  ++column_;
  return true;
}

int64_t RowReader::Integer() {
  const int64_t value = statement_.Integer(Next(SQLITE_INTEGER));
  checksum_.Add(value);
  return value;
}

double RowReader::Real() {
  const double value = statement_.Real(Next(SQLITE_FLOAT));
  if (!std::isfinite(value)) Fail("a value is not finite");
  checksum_.Add(value);
  return value;
}

double RowReader::Metres() {
  const auto micrometres = static_cast<double>(Integer());
  if (!(std::abs(micrometres) <= kMaxMicrometres)) Fail("a position is too far away");
  return micrometres / kMicrometres;
}

std::string_view RowReader::Text() {
  const std::string_view text = statement_.Bytes(Next(SQLITE_TEXT));
  checksum_.AddText(text);
  return text;
}

std::string_view RowReader::Blob() {
  const std::string_view bytes = statement_.Bytes(Next(SQLITE_BLOB));
  checksum_.AddBlob(bytes);
  return bytes;
}

void RowReader::Finish() {
  if (statement_.Integer(Next(SQLITE_INTEGER)) != checksum_.value()) {
    Fail("its checksum does not fit");
  }
}

void RowReader::Fail(const std::string& problem) const {
  RefuseDamaged(path_, std::string("table ") + table_ + ", row " +
                           std::to_string(statement_.Integer(0)) + ": " + problem);
}

void ForEachRow(const SqliteDatabase& database, const char* table, const char* key,
                const std::function<void(RowReader*)>& read) {
  SqliteStatement rows =
      database.Prepare(std::string("SELECT * FROM ") + table + " ORDER BY " + key);
  while (rows.Step()) {
    RowReader row(rows, database.path(), table);
    try {
      read(&row);
    } catch (const BlobError& error) {
      row.Fail(error.what());
    }
  }
}

}  // namespace msc_vo
