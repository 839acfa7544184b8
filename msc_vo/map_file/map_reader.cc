// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/map_reader.h"

#include <stdexcept>

#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/sqlite_database.h"
#include "msc_vo/map_file/internal/table_reader.h"

namespace msc_vo {

namespace {

// Calls read(database) in a transaction, so that all of it sees the same state.
template <typename Read>
auto ReadFrom(const std::string& path, const Read& read) {
  const SqliteDatabase database(path, SqliteDatabase::Access::kRead);
  database.Execute("BEGIN");  // ended with the connection
  CheckSchema(database);
  return read(database);
}

int64_t Count(const SqliteDatabase& database, const std::string& table, int64_t submap) {
  return database.Integer("SELECT count(*) FROM " + table +
                          " WHERE submap = " + std::to_string(submap));
}

void AddSessions(const SqliteDatabase& database, MapFileSummary* summary) {
  SqliteStatement sessions = database.Prepare(
      "SELECT name, (SELECT count(*) FROM keyframe WHERE keyframe.id >= first_keyframe AND "
      "keyframe.id < coalesce((SELECT min(next.first_keyframe) FROM session AS next WHERE next.id "
      "> session.id), 9223372036854775807)) FROM session ORDER BY id");
  while (sessions.Step()) {
    summary->sessions.push_back({std::string(sessions.Bytes(0)), sessions.Integer(1)});
  }
}

}  // namespace

MapContents LoadMap(const std::string& path) {
  return ReadFrom(path, [](const SqliteDatabase& database) {
    CalibrationRows calibrations;
    return ReadTables(database, &calibrations);
  });
}

bool IsMapFile(const std::string& path) { return ApplicationIdOf(path) == kApplicationId; }

void CheckMap(const std::string& path) {
  ReadFrom(path, [&](const SqliteDatabase& database) {
    SqliteStatement check = database.Prepare("PRAGMA integrity_check(1)");
    if (check.Step() && check.Bytes(0) != "ok") {
      RefuseDamaged(path, std::string(check.Bytes(0)));
    }
    CalibrationRows calibrations;
    return ReadTables(database, &calibrations);
  });
}

MapFileSummary SummarizeMap(const std::string& path) {
  return ReadFrom(path, [](const SqliteDatabase& database) {
    MapFileSummary summary;
    summary.version = SchemaVersion(database);
    summary.num_bytes =
        database.Integer("PRAGMA page_count") * database.Integer("PRAGMA page_size");
    if (summary.version >= kFirstVersionWithImages) {
      summary.num_images = database.Integer("SELECT count(*) FROM image");
    }
    summary.num_loop_edges = database.Integer("SELECT count(*) FROM loop");
    SqliteStatement program = database.Prepare("SELECT program FROM map");
    if (program.Step()) summary.program = program.Bytes(0);
    AddSessions(database, &summary);
    SqliteStatement submaps = database.Prepare("SELECT id FROM submap ORDER BY id");
    while (submaps.Step()) {
      const int64_t id = submaps.Integer(0);
      const bool has_planes = summary.version >= kFirstVersionWithPlanes;
      summary.submaps.push_back({id, Count(database, "keyframe", id), Count(database, "point", id),
                                 Count(database, "line", id),
                                 has_planes ? Count(database, "plane", id) : 0});
    }
    return summary;
  });
}

}  // namespace msc_vo
