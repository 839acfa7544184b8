// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/map_schema.h"

#include <stdexcept>
#include <string>
#include <type_traits>

namespace msc_vo {

namespace {

// Without an index or a view of its own: every query is by the id.
constexpr struct {
  const char* name;
  int first_version, last_version;
  const char* sql;
} kTables[] = {
    {"map", 1, kMapFileVersion,
     "CREATE TABLE map (id INTEGER PRIMARY KEY, next_keyframe INTEGER NOT NULL, next_landmark "
     "INTEGER NOT NULL, program TEXT NOT NULL, checksum INTEGER NOT NULL)"},
    {"session", 1, kMapFileVersion,
     "CREATE TABLE session (id INTEGER PRIMARY KEY, first_keyframe INTEGER NOT NULL, name TEXT NOT "
     "NULL, checksum INTEGER NOT NULL)"},
    {"calibration", 1, kMapFileVersion,
     "CREATE TABLE calibration (id INTEGER PRIMARY KEY, width INTEGER NOT NULL, height INTEGER NOT "
     "NULL, fx REAL NOT NULL, fy REAL NOT NULL, cx REAL NOT NULL, cy REAL NOT NULL, lens TEXT, "
     "coefficients BLOB, recorded BLOB, registration BLOB, checksum INTEGER NOT NULL)"},
    {"submap", 1, 1,
     "CREATE TABLE submap (id INTEGER PRIMARY KEY, qx REAL, qy REAL, qz REAL, qw REAL, sigma REAL, "
     "deviation REAL, point_depth_noise REAL NOT NULL, line_pixel_noise REAL NOT NULL, "
     "line_depth_noise REAL NOT NULL, checksum INTEGER NOT NULL)"},
    {"submap", 2, kMapFileVersion,
     "CREATE TABLE submap (id INTEGER PRIMARY KEY, qx REAL, qy REAL, qz REAL, qw REAL, sigma REAL, "
     "deviation REAL, point_depth_noise REAL NOT NULL, line_pixel_noise REAL NOT NULL, "
     "line_depth_noise REAL NOT NULL, plane_noise REAL NOT NULL, checksum INTEGER NOT NULL)"},
    {"keyframe", 1, kMapFileVersion,
     "CREATE TABLE keyframe (id INTEGER PRIMARY KEY, submap INTEGER NOT NULL, qx REAL NOT NULL, qy "
     "REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL, tx REAL NOT NULL, ty REAL NOT NULL, tz "
     "REAL NOT NULL, checksum INTEGER NOT NULL)"},
    {"features", 1, kMapFileVersion,
     "CREATE TABLE features (keyframe INTEGER PRIMARY KEY, frame INTEGER NOT NULL, timestamp REAL "
     "NOT NULL, calibration INTEGER NOT NULL, points BLOB NOT NULL, point_landmarks BLOB NOT NULL, "
     "lines BLOB NOT NULL, line_landmarks BLOB NOT NULL, depth_ranges BLOB NOT NULL, step BLOB "
     "NOT NULL, checksum INTEGER NOT NULL)"},
    {"point", 1, kMapFileVersion,
     "CREATE TABLE point (id INTEGER PRIMARY KEY, submap INTEGER NOT NULL, first_keyframe INTEGER "
     "NOT NULL, x INTEGER NOT NULL, y INTEGER NOT NULL, z INTEGER NOT NULL, visible INTEGER NOT "
     "NULL, found INTEGER NOT NULL, noise REAL NOT NULL, checksum INTEGER NOT NULL)"},
    {"line", 1, kMapFileVersion,
     "CREATE TABLE line (id INTEGER PRIMARY KEY, submap INTEGER NOT NULL, first_keyframe INTEGER "
     "NOT NULL, start_x INTEGER NOT NULL, start_y INTEGER NOT NULL, start_z INTEGER NOT NULL, "
     "end_x INTEGER NOT NULL, end_y INTEGER NOT NULL, end_z INTEGER NOT NULL, depth_offset INTEGER "
     "NOT NULL, visible INTEGER NOT NULL, found INTEGER NOT NULL, noise REAL NOT NULL, checksum "
     "INTEGER NOT NULL)"},
    {"plane_features", 2, kMapFileVersion,
     "CREATE TABLE plane_features (keyframe INTEGER PRIMARY KEY, planes BLOB NOT NULL, checksum "
     "INTEGER NOT NULL)"},
    {"plane", 2, kMapFileVersion,
     "CREATE TABLE plane (id INTEGER PRIMARY KEY, submap INTEGER NOT NULL, host INTEGER NOT NULL, "
     "nx REAL NOT NULL, ny REAL NOT NULL, nz REAL NOT NULL, d REAL NOT NULL, extent BLOB NOT NULL, "
     "observations BLOB NOT NULL, checksum INTEGER NOT NULL)"},
    {"false_depth", 3, kMapFileVersion,
     "CREATE TABLE false_depth (landmark INTEGER PRIMARY KEY, checksum INTEGER NOT NULL)"},
    {"image", 4, kMapFileVersion,
     "CREATE TABLE image (keyframe INTEGER PRIMARY KEY, jpeg BLOB NOT NULL, checksum INTEGER NOT "
     "NULL)"},
    {"loop", 1, kMapFileVersion,
     "CREATE TABLE loop (id INTEGER PRIMARY KEY, from_keyframe INTEGER NOT NULL, to_keyframe "
     "INTEGER NOT NULL, qx REAL NOT NULL, qy REAL NOT NULL, qz REAL NOT NULL, qw REAL NOT NULL, tx "
     "REAL NOT NULL, ty REAL NOT NULL, tz REAL NOT NULL, covariance BLOB NOT NULL, checksum "
     "INTEGER NOT NULL)"},
};

using Table = std::remove_reference_t<decltype(kTables[0])>;

bool IsOf(const Table& table, int64_t version) {
  return version >= table.first_version && version <= table.last_version;
}

void SetVersion(const SqliteDatabase& database) {
  database.Execute("PRAGMA user_version = " + std::to_string(kMapFileVersion));
}

[[noreturn]] void Fail(const SqliteDatabase& database, const std::string& problem) {
  throw std::runtime_error(database.path() + ": " + problem);
}

int64_t NumObjects(const SqliteDatabase& database) {
  return database.Integer("SELECT count(*) FROM sqlite_master");
}

}  // namespace

bool IsEmptyDatabase(const SqliteDatabase& database) {
  return database.Integer("PRAGMA application_id") == 0 && NumObjects(database) == 0;
}

void CreateSchema(const SqliteDatabase& database) {
  database.Execute("PRAGMA application_id = " + std::to_string(kApplicationId));
  SetVersion(database);
  for (const Table& table : kTables) {
    if (IsOf(table, kMapFileVersion)) database.Execute(table.sql);
  }
}

int SchemaVersion(const SqliteDatabase& database) {
  return static_cast<int>(database.Integer("PRAGMA user_version"));
}

void UpgradeSchema(const SqliteDatabase& database) {
  const int version = SchemaVersion(database);
  if (version == kMapFileVersion) return;
  for (const Table& table : kTables) {
    if (IsOf(table, version) && !IsOf(table, kMapFileVersion)) {
      database.Execute(std::string("DROP TABLE ") + table.name);
    }
  }
  for (const Table& table : kTables) {
    if (!IsOf(table, version) && IsOf(table, kMapFileVersion)) database.Execute(table.sql);
  }
  SetVersion(database);
}

void CheckSchema(const SqliteDatabase& database) {
  if (IsEmptyDatabase(database)) {
    Fail(database, "is empty: no map has been written to it; build one with msc_vo replay --map");
  }
  if (database.Integer("PRAGMA application_id") != kApplicationId) {
    Fail(database, "is no map of msc_vo, but another SQLite file; choose another file");
  }
  const int64_t version = database.Integer("PRAGMA user_version");
  if (version > kMapFileVersion) {
    Fail(database, "has version " + std::to_string(version) + " of the format, and this program " +
                       "reads up to version " + std::to_string(kMapFileVersion) +
                       "; use a newer msc_vo");
  }
  if (version < 1) RefuseDamaged(database.path(), "its version is not valid");
  int64_t num_tables = 0;
  for (const Table& table : kTables) {
    if (!IsOf(table, version)) continue;
    SqliteStatement find = database.Prepare("SELECT sql FROM sqlite_master WHERE name = ?");
    find.BindText(0, table.name);
    if (!find.Step() || find.Bytes(0) != table.sql) {
      RefuseDamaged(database.path(), std::string("its table ") + table.name + " is not valid");
    }
    ++num_tables;
  }
  if (NumObjects(database) != num_tables) {
    RefuseDamaged(database.path(), "it contains what is no part of a map");
  }
}

}  // namespace msc_vo
