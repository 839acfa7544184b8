// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <vector>

#include "tests/ros_bag/bag_writer.h"
#include <sqlite3.h>
#include <zstd.h>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// As the plugin rosbag2_storage_sqlite3 lays out its files.
class Db3Writer : public BagWriter {
 public:
  Db3Writer(const std::string& path, bool is_compressed)
      : BagWriter(RosSerialization::kCdr), is_compressed_(is_compressed) {
    if (sqlite3_open(path.c_str(), &database_) != SQLITE_OK) throw std::runtime_error(path);
    Execute(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
    Execute(
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
    Execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
    Execute("BEGIN");
  }
  ~Db3Writer() override {
    Execute("COMMIT");
    sqlite3_close(database_);
  }

  void Write(const std::string& topic, const std::string& type, double seconds,
             const std::string& bytes) override {
    const auto [id, is_new] = topics_.try_emplace(topic, static_cast<int>(topics_.size()) + 1);
    if (is_new) {
      std::string ros2_type = type;
      if (type.find("librealsense") != 0) ros2_type.insert(type.find('/'), "/msg");
      Execute("INSERT INTO topics VALUES(" + std::to_string(id->second) + ", '" + topic + "', '" +
              ros2_type + "', 'cdr', '')");
    }
    sqlite3_stmt* insert = nullptr;
    sqlite3_prepare_v2(database_, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                       -1, &insert, nullptr);
    const std::string data = is_compressed_ ? Zstd(bytes) : bytes;
    sqlite3_bind_int(insert, 1, id->second);
    sqlite3_bind_int64(insert, 2, std::llround(1e9 * seconds));
    sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    sqlite3_step(insert);
    sqlite3_finalize(insert);
  }

 private:
  void Execute(const std::string& sql) {
    sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr);
  }

  sqlite3* database_ = nullptr;
  bool is_compressed_;
  std::map<std::string, int> topics_;
};

}  // namespace

std::unique_ptr<BagWriter> WriteDb3Bag(const std::string& path, const std::string& compression) {
  return std::make_unique<Db3Writer>(path, compression == "zstd");
}

std::string Zstd(const std::string& bytes) {
  std::string compressed(ZSTD_compressBound(bytes.size()), '\0');
  compressed.resize(
      ZSTD_compress(compressed.data(), compressed.size(), bytes.data(), bytes.size(), 1));
  return compressed;
}

void CompressFile(const std::string& path, const std::string& compressed) {
  std::ofstream(compressed, std::ios::binary) << Zstd(ReadFile(path));
}

}  // namespace msc_vo
