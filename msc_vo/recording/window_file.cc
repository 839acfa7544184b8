// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/recording/window_file.h"

#include <set>
#include <stdexcept>
#include <type_traits>

#include "msc_vo/config/option_list.h"
#include "msc_vo/recording/window_record.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/text/text_record.h"

namespace msc_vo {

namespace {

// Increases with every change that an older reader would misinterpret.
constexpr int kFormatVersion = 1;
constexpr char kFormatKeyword[] = "msc_vo_window";
constexpr char kOptionKeyword[] = "option";
constexpr char kEndKeyword[] = "end";

constexpr char kPreamble[] =
    "# A window of msc_vo: keyframes, landmarks and their observations, as input or result of a\n"
    "# local bundle adjustment. One record per line; the comment above the records of each kind\n"
    "# names their fields. Numbers are exact. Solve it: msc_vo solve-window THIS_FILE\n";

// Returns the names of the fields of a kind of record.
template <typename Record, typename Item>
std::string NamesOf(Record, const Item& item) {
  FieldNames names;
  Record::Visit(item, names);
  return names.text();
}

// Type of the items of a kind of record in WindowData.
template <typename Record>
using ItemOf = typename std::decay_t<decltype(WindowData().*Record::kItems)>::value_type;

class WindowWriter {
 public:
  std::string Write(const BundleAdjustmentOptions& options, const WindowData& data) {
    text_ = kPreamble;
    text_ += std::string(kFormatKeyword) + " " + std::to_string(kFormatVersion) + "\n";
    WriteOptions(options);
    WriteComment(CameraRecord(), data.camera);
    Write(CameraRecord(), data.camera);
    ForEachWindowRecord([&](auto record) {
      using Record = decltype(record);
      WriteComment(record, ItemOf<Record>());
      for (const auto& item : data.*Record::kItems) Write(record, item);
    });
    text_ +=
        "# end NUMBER: of records between the version and this line, to detect a truncated file\n";
    text_ += std::string(kEndKeyword) + " " + std::to_string(num_records_) + "\n";
    return std::move(text_);
  }

 private:
  void WriteOptions(const BundleAdjustmentOptions& options) {
    BundleAdjustmentOptions written = options;
    text_ += "# option NAME VALUE: of local bundle adjustment (docs/window_file.md)\n";
    for (const Option& option : ListWindowOptions(&written)) {
      text_ += std::string(kOptionKeyword) + " " + option.path + " " + FormatOption(option) + "\n";
      ++num_records_;
    }
  }

  template <typename Record, typename Item>
  void WriteComment(Record record, const Item& item) {
    text_ += std::string("# ") + Record::kKeyword + " " + NamesOf(record, item) + ": " +
             Record::kComment + "\n";
  }

  template <typename Record, typename Item>
  void Write(Record, const Item& item) {
    FieldWriter writer(Record::kKeyword, &text_);
    Record::Visit(item, writer);
    writer.EndRecord();
    ++num_records_;
  }

  std::string text_;
  int64_t num_records_ = 0;
};

class WindowReader {
 public:
  WindowReader() : options_(ListWindowOptions(&window_.options)) {}

  RecordedWindow Read(const std::string& path) {
    const std::vector<TextLine> lines = ReadTextLines(path);
    if (lines.empty()) throw std::runtime_error(path + ": is empty; a window file is needed");
    CheckVersion(lines.front());
    for (size_t i = 1; i < lines.size(); ++i) {
      if (ended_) lines[i].Fail("is after the 'end' record; remove it");
      ReadLine(lines[i], static_cast<int64_t>(i) - 1);
    }
    if (!ended_) {
      lines.back().Fail(
          "the file ends here without an 'end' record: it is truncated; record it again");
    }
    return std::move(window_);
  }

 private:
  static void CheckVersion(const TextLine& line) {
    if (line.fields.front() != kFormatKeyword) {
      line.Fail("is not a window file: its first record must be '" + std::string(kFormatKeyword) +
                " " + std::to_string(kFormatVersion) + "'");
    }
    FieldReader fields(line, "VERSION");
    int version = 0;
    fields.Integer("VERSION", version);
    fields.EndRecord();
    if (version < 1 || version > kFormatVersion) {
      line.Fail("version " + std::to_string(version) +
                " of the window file is not supported, only 1" +
                (kFormatVersion > 1 ? " to " + std::to_string(kFormatVersion) : "") +
                "; read it with the msc_vo that wrote it, or a newer one");
    }
  }

  void ReadLine(const TextLine& line, int64_t num_records_before) {
    const std::string& keyword = line.fields.front();
    if (keyword == kOptionKeyword) {
      ReadOption(line);
    } else if (keyword == CameraRecord::kKeyword) {
      if (!keys_.insert(keyword).second) line.Fail("a second camera; remove one of them");
      ReadFields(CameraRecord(), line, &window_.data.camera);
    } else if (keyword == kEndKeyword) {
      ReadEnd(line, num_records_before);
    } else {
      ReadItem(line);
    }
  }

  void ReadOption(const TextLine& line) {
    if (line.fields.size() != 3) line.Fail("expected 'option NAME VALUE'");
    const std::string& path = line.fields[1];
    const Option* option = FindByPath(options_, path);
    if (!option) {
      line.Fail(UnknownOptionMessage(options_, path, "remove the line to take the defaults"));
    }
    if (!keys_.insert(path).second) line.Fail("'" + path + "' is given twice; remove one of them");
    std::string expected;
    if (!SetOption(*option, line.fields[2], &expected)) {
      line.Fail("'" + path + "' must be " + expected + ", not '" + line.fields[2] + "'");
    }
  }

  void ReadItem(const TextLine& line) {
    bool known = false;
    std::string keywords = std::string(kOptionKeyword) + " " + CameraRecord::kKeyword;
    ForEachWindowRecord([&](auto record) {
      using Record = decltype(record);
      keywords += std::string(" ") + Record::kKeyword;
      if (line.fields.front() != Record::kKeyword) return;
      known = true;
      auto& items = window_.data.*Record::kItems;
      items.emplace_back();
      ReadFields(record, line, &items.back());
    });
    if (!known) {
      line.Fail("unknown record '" + line.fields.front() + "'; known are " + keywords + " " +
                kEndKeyword);
    }
  }

  template <typename Record, typename Item>
  static void ReadFields(Record record, const TextLine& line, Item* item) {
    FieldReader fields(line, NamesOf(record, *item));
    Record::Visit(*item, fields);
    fields.EndRecord();
  }

  void ReadEnd(const TextLine& line, int64_t num_records_before) {
    FieldReader fields(line, "NUMBER_OF_RECORDS");
    int64_t num_records = 0;
    fields.Integer("NUMBER_OF_RECORDS", num_records);
    fields.EndRecord();
    if (num_records != num_records_before) {
      line.Fail("'end' gives " + std::to_string(num_records) + " records, but the file has " +
                std::to_string(num_records_before) +
                "; correct the number if you edited the file, otherwise record it again");
    }
    if (keys_.count(CameraRecord::kKeyword) == 0) {
      line.Fail("the window has no camera; add 'camera " +
                NamesOf(CameraRecord(), window_.data.camera) + "' above");
    }
    ended_ = true;
  }

  RecordedWindow window_;
  std::vector<Option> options_;  // into window_
  std::set<std::string> keys_;   // records and options read so far that may occur only once
  bool ended_ = false;
};

}  // namespace

std::string FormatWindow(const BundleAdjustmentOptions& options, const WindowData& data) {
  return WindowWriter().Write(options, data);
}

void WriteWindow(const std::string& path, const BundleAdjustmentOptions& options,
                 const WindowData& data) {
  WriteFile(path, FormatWindow(options, data));
}

RecordedWindow ReadWindow(const std::string& path) { return WindowReader().Read(path); }

}  // namespace msc_vo
