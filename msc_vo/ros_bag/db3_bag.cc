// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <sqlite3.h>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/decompression.h"
#include "msc_vo/ros_bag/topic_messages.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

constexpr char kRecover[] =
    "; 'sqlite3 FILE .recover | sqlite3 COPY.db3' saves what is left of a damaged file in a copy";

void Check(sqlite3* database, bool is_good) {
  if (!is_good) throw std::runtime_error(sqlite3_errmsg(database));
}

std::string UriOf(const std::string& file) {
  std::string uri = "file:";
  for (const char c : file) {
    const bool has_meaning = c == '?' || c == '#' || c == '%';
    uri += has_meaning ? FormatText("%%%02x", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return uri;
}

// Tests whether a file is shorter than its header says (sqlite.org/fileformat.html).
bool IsCutOff(const std::string& file) {
  constexpr size_t kPageSizeAt = 16, kNumPagesAt = 28, kHeader = 32;
  const std::string header = ReadBeginning(file, kHeader);
  if (header.size() < kHeader) return false;
  const auto read = [&](size_t at, size_t num_bytes) {  // the most significant byte is the first
    uint64_t value = 0;
    for (size_t i = at; i < at + num_bytes; ++i) {
      value = (value << 8) | static_cast<uint8_t>(header[i]);
    }
    return value;
  };
  return std::filesystem::file_size(file) < read(kPageSizeAt, 2) * read(kNumPagesAt, 4);
}

Database Open(const std::string& file) {
  // A recorder that was killed may have left a log beside the file, which SQLite takes into
  // account. Without one, nothing is written beside the file.
  std::error_code missing;
  const auto log_bytes = std::filesystem::file_size(file + "-wal", missing);
  const bool has_log = !missing && log_bytes > 0;
  const std::string mode = has_log ? "?mode=ro" : "?immutable=1";
  sqlite3* opened = nullptr;
  const int result = sqlite3_open_v2((UriOf(file) + mode).c_str(), &opened,
                                     SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(opened);
  Check(opened, result == SQLITE_OK);
  // SQLite reads files that were cut off only with this flag; nothing is written with it either.
  const bool is_cut_off = !has_log && IsCutOff(file);
  sqlite3_db_config(
      opened, is_cut_off ? SQLITE_DBCONFIG_WRITABLE_SCHEMA : SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_exec(opened, "PRAGMA trusted_schema = OFF", nullptr, nullptr, nullptr);
  sqlite3_exec(opened, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
  return database;
}

Statement Prepare(sqlite3* database, const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr);
  Statement owned(statement);
  Check(database, result == SQLITE_OK);
  return owned;
}

bool Step(sqlite3* database, sqlite3_stmt* statement) {
  const int result = sqlite3_step(statement);
  Check(database, result == SQLITE_ROW || result == SQLITE_DONE);
  return result == SQLITE_ROW;
}

std::string Bytes(sqlite3_stmt* statement, int column) {
  const void* data = sqlite3_column_blob(statement, column);
  const int size = sqlite3_column_bytes(statement, column);
  return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), size);
}

class Db3Bag : public BagFile {
 public:
  Db3Bag(const std::string& path, const std::string& file) : BagFile(path), database_(Open(file)) {
    std::map<int64_t, std::string> names;
    std::vector<BagTopic> topics;
    const Statement rows = Select("SELECT id, name, type FROM topics ORDER BY id");
    while (Step(database_.get(), rows.get())) {
      names[sqlite3_column_int64(rows.get(), 0)] = Bytes(rows.get(), 1);
      topics.push_back(
          {Bytes(rows.get(), 1), WithoutMsg(Bytes(rows.get(), 2)), RosSerialization::kCdr});
    }
    SetTopics(std::move(topics));
    data_ = Select("SELECT data FROM messages WHERE id = ?");
    ListMessages(names);
  }

 private:
  struct Message {
    int64_t id;
    int64_t time;  // nanoseconds
  };

  // Of a file that was cut off, lists the messages before the first page that is missing.
  void ListMessages(const std::map<int64_t, std::string>& names) {
    const Statement times = Select("SELECT id, topic_id, timestamp FROM messages ORDER BY id");
    bool has_messages = false;
    try {
      for (; Step(database_.get(), times.get()); has_messages = true) {
        const auto name = names.find(sqlite3_column_int64(times.get(), 1));
        if (name == names.end()) continue;
        messages_.Add(name->second,
                      {sqlite3_column_int64(times.get(), 0), sqlite3_column_int64(times.get(), 2)});
      }
    } catch (const std::runtime_error& error) {
      if (!has_messages) throw;
      Warn(path() + ": " + error.what() + "; the messages before the damage are read" + kRecover);
    }
  }

  Statement Select(const std::string& sql) const { return Prepare(database_.get(), sql); }

  int DoCount(const BagTopic& topic) const override { return messages_.Count(topic.name); }
  std::string DoRead(const BagTopic& topic, int i) const override {
    sqlite3_reset(data_.get());
    sqlite3_bind_int64(data_.get(), 1, messages_.At(topic.name, i).id);
    Check(database_.get(), Step(database_.get(), data_.get()));
    return UnpackMessage(Bytes(data_.get(), 0));
  }
  double DoReceiveTime(const BagTopic& topic, int i) const override {
    return SecondsOf(messages_.At(topic.name, i).time);
  }

  Database database_;
  TopicMessages<Message> messages_;
  Statement data_;
};

}  // namespace

std::unique_ptr<BagFile> OpenDb3Bag(const std::string& path, const std::string& file) {
  try {
    return std::make_unique<Db3Bag>(path, file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": cannot be read as a bag of ROS 2: " + error.what() +
                             kRecover);
  }
}

}  // namespace msc_vo
