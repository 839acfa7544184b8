// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A map file, changed as the input says: its bytes, or values of its rows, whose checksums then
// fit. It is refused, or it is a map without violations that can be saved again.

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/input_folder.h"
#include "tests/map_file/random_map.h"
#include <sqlite3.h>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/map_file/internal/row.h"
#include "msc_vo/map_file/internal/sqlite_database.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"

namespace msc_vo {
namespace {

constexpr const char* kTables[] = {
    "map",   "session", "calibration", "submap",         "keyframe",    "features", "features",
    "point", "line",    "plane",       "plane_features", "false_depth", "image",    "loop"};

// The folder and the bytes of a valid file.
struct Files {
  Files() {
    RandomMap random;
    MapContents contents = AsContents(random.Make(3));
    contents.submaps[0].axes = AxesEstimate{Eigen::Quaterniond::Identity(), 0.01, 0.02};
    contents.loops.push_back({0, 2, Rigid3(), PoseCovariance::Identity()});
    Map second = random.Make(2, contents.submaps[0].map);
    contents.sessions.push_back({3, "second"});
    contents.submaps.push_back({1, std::move(second), {}, {}});
    SaveMap(path, std::move(contents),
            [](KeyframeId id) { return "\xff\xd8\xff" + std::string(40, static_cast<char>(id)); });
    std::ifstream file(path, std::ios::binary);
    valid.assign(std::istreambuf_iterator<char>(file), {});
  }

  InputFolder folder;
  std::string path = folder.Path("home.map");
  std::string valid;
};

// A value of a row.
struct Value {
  int type = SQLITE_NULL;
  int64_t integer = 0;
  double real = 0.0;
  std::string bytes;
};

std::vector<Value> ReadRow(const SqliteStatement& statement, int num_columns) {
  std::vector<Value> row;
  for (int i = 0; i < num_columns; ++i) {
    row.push_back({statement.Type(i), statement.Integer(i), statement.Real(i),
                   std::string(statement.Bytes(i))});
  }
  return row;
}

// Without the checksum.
void WriteRow(const SqliteDatabase& database, const std::string& table,
              const std::vector<Value>& values) {
  std::string sql = "INSERT OR REPLACE INTO " + table + " VALUES (?";
  for (size_t i = 0; i < values.size(); ++i) sql += ", ?";
  SqliteStatement insert = database.Prepare(sql + ")");
  RowWriter row(&insert);
  for (const Value& value : values) {
    switch (value.type) {
      case SQLITE_INTEGER:
        row.Integer(value.integer);
        break;
      case SQLITE_FLOAT:
        row.Real(value.real);
        break;
      case SQLITE_TEXT:
        row.Text(value.bytes);
        break;
      case SQLITE_BLOB:
        row.Blob(value.bytes);
        break;
      default:
        row.Null();
    }
  }
  row.Execute();
}

void ChangeBytes(ByteReader* input, std::string* bytes) {
  size_t at = input->Byte();
  at = (at << 8 | input->Byte()) << 8;
  at = (at | input->Byte()) % (bytes->size() + 1);
  switch (input->Below(4)) {
    case 0:
      bytes->resize(at);
      return;
    case 1:
      bytes->erase(at, input->Byte());
      return;
    case 2:
      bytes->insert(at, bytes->substr(at, input->Byte()));
      return;
    default:
      if (at < bytes->size()) (*bytes)[at] = static_cast<char>(input->Byte());
  }
}

void Change(ByteReader* input, Value* value) {
  switch (value->type) {
    case SQLITE_INTEGER:
      value->integer = input->Below(2) == 0 ? input->Integer() : value->integer + 1;
      return;
    case SQLITE_FLOAT:
      value->real = input->NumberFor(value->real);
      if (!std::isfinite(value->real)) value->real = 0.0;
      return;
    case SQLITE_NULL:
      value->type = SQLITE_BLOB;
      return;
    default:
      if (input->Below(8) == 0) value->type = SQLITE_NULL;
      ChangeBytes(input, &value->bytes);
  }
}

// Changes, copies or deletes a row.
void ChangeRow(ByteReader* input, const SqliteDatabase& database) {
  const std::string table = kTables[input->Below(std::size(kTables))];
  const int num_columns =
      static_cast<int>(database.Integer("SELECT count(*) FROM pragma_table_info('" + table + "')"));
  SqliteStatement rows = database.Prepare("SELECT * FROM " + table);
  std::vector<std::vector<Value>> all;
  while (rows.Step()) all.push_back(ReadRow(rows, num_columns - 1));
  if (all.empty()) return;
  std::vector<Value>& row = all[input->Below(all.size())];
  if (input->Below(16) == 0) {
    database.Execute("DELETE FROM " + table + " WHERE rowid = " + std::to_string(row[0].integer));
    return;
  }
  Change(input, &row[input->Below(row.size())]);
  try {
    WriteRow(database, table, row);
  } catch (const std::exception&) {
    // SQLite refuses what the declaration of the table excludes.
  }
}

// Made before the first input, whose time is limited.
Files files;

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  ByteReader input(data, size);
  std::string bytes = files.valid;
  constexpr int kMaxChanges = 6;
  const bool changes_bytes = input.Below(4) == 1;
  for (int i = 0; i < kMaxChanges && changes_bytes && !input.AtEnd(); ++i) {
    ChangeBytes(&input, &bytes);
  }
  std::filesystem::remove(files.path + "-journal");
  files.folder.Write("home.map", bytes);
  if (!changes_bytes) {
    const SqliteDatabase database(files.path, SqliteDatabase::Access::kWrite);
    database.Execute("PRAGMA journal_mode = MEMORY");
    for (int i = 0; i < kMaxChanges && !input.AtEnd(); ++i) ChangeRow(&input, database);
  }
  Accepts(files.path, [] {
    MapContents contents = LoadMap(files.path);
    for (const SavedSubMap& submap : contents.submaps) {
      Require(FirstViolation(submap.map).empty(), "a map without violations");
    }
    SummarizeMap(files.path);
    const MapImages images(files.path);
    for (const KeyframeId id : images.Keyframes()) {
      Require(FindKeyframe(contents, id) != nullptr, "an image of a keyframe");
      Require(!images.Read(id).empty(), "an image");
    }
    std::filesystem::remove(files.folder.Path("copy.map"));
    SaveMap(files.folder.Path("copy.map"), std::move(contents));
    LoadMap(files.folder.Path("copy.map"));
  });
  return 0;
}
