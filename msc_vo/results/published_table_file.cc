// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// ReadPublishedTable().

#include <algorithm>
#include <set>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

#include "msc_vo/results/published_table.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

class TableReader {
 public:
  explicit TableReader(std::string file) : file_(std::move(file)) {}

  PublishedTable Read() {
    YAML::Node root;
    try {
      root = YAML::Load(ReadText(file_, kMaxOptionsBytes));
    } catch (const YAML::Exception& error) {
      throw std::runtime_error(file_ + ":" + std::to_string(error.mark.line + 1) +
                               ": malformed YAML: " + error.msg);
    }
    CheckKeys(root, {"title", "datasets", "systems", "sequences"});
    PublishedTable table;
    table.title = Text(root, "title");
    for (const YAML::Node& node : List(root, "datasets")) {
      CheckKeys(node, {"name", "url"});
      urls_[Text(node, "name")] = Text(node, "url");
    }
    if (root["systems"]) {
      for (const YAML::Node& node : List(root, "systems")) {
        CheckKeys(node, {"name", "source"});
        table.systems.push_back({Text(node, "name"), Text(node, "source")});
        systems_.insert(table.systems.back().name);
      }
    }
    std::set<std::string> names;
    for (const YAML::Node& node : List(root, "sequences")) {
      table.sequences.push_back(ReadSequence(node));
      if (!names.insert(table.sequences.back().name).second) {
        Fail(node, "the sequence '" + table.sequences.back().name + "' is given twice");
      }
    }
    return table;
  }

 private:
  [[noreturn]] void Fail(const YAML::Node& node, const std::string& what) const {
    throw std::runtime_error(file_ + ":" + std::to_string(node.Mark().line + 1) + ": " + what);
  }

  void CheckKeys(const YAML::Node& node, const std::vector<std::string>& keys) const {
    const std::string names = Joined(keys, ", ");
    if (!node.IsMap()) Fail(node, "expected a section with the keys " + names);
    for (const auto& entry : node) {
      if (std::find(keys.begin(), keys.end(), entry.first.Scalar()) != keys.end()) continue;
      Fail(entry.first, "'" + entry.first.Scalar() + "' is none of the keys " + names);
    }
  }

  std::string Text(const YAML::Node& node, const char* key) const {
    const YAML::Node value = node[key];
    if (!value) Fail(node, std::string("the key '") + key + "' is missing");
    if (!value.IsScalar() || value.Scalar().empty()) {
      Fail(value, std::string("'") + key + "' must be a text");
    }
    return value.Scalar();
  }

  std::vector<YAML::Node> List(const YAML::Node& node, const char* key) const {
    const YAML::Node list = node[key];
    if (!list) Fail(node, std::string("the key '") + key + "' is missing");
    if (!list.IsSequence() || list.size() == 0) {
      Fail(list, std::string("'") + key + "' must be a list with an entry or more");
    }
    return {list.begin(), list.end()};
  }

  PublishedSequence ReadSequence(const YAML::Node& node) const {
    CheckKeys(node, {"name", "dataset", "folders", "format", "camera", "errors"});
    PublishedSequence sequence;
    sequence.name = Text(node, "name");
    // It names a folder of results.
    if (!std::all_of(sequence.name.begin(), sequence.name.end(),
                     [](char c) { return IsLetterOrDigit(c) || c == '-' || c == '_'; })) {
      Fail(node["name"], "'" + sequence.name + "' may have letters, digits, - and _ only");
    }
    sequence.dataset = Text(node, "dataset");
    const auto url = urls_.find(sequence.dataset);
    if (url == urls_.end()) {
      Fail(node["dataset"], "'" + sequence.dataset + "' is none of the datasets above");
    }
    sequence.url = url->second;
    for (const YAML::Node& folder : List(node, "folders")) {
      if (!folder.IsScalar() || folder.Scalar().empty() || folder.Scalar()[0] == '/') {
        Fail(folder, "a folder must be a relative path");
      }
      sequence.folders.push_back(folder.Scalar());
    }
    if (node["format"]) sequence.format = Text(node, "format");
    if (node["camera"]) sequence.camera = Text(node, "camera");
    if (node["errors"]) ReadErrors(node["errors"], &sequence);
    return sequence;
  }

  void ReadErrors(const YAML::Node& node, PublishedSequence* sequence) const {
    if (!node.IsMap()) Fail(node, "'errors' must be a section 'SYSTEM: metres'");
    for (const auto& entry : node) {
      const std::string system = entry.first.Scalar();
      if (systems_.count(system) == 0) {
        Fail(entry.first, "'" + system + "' is none of the systems above");
      }
      const std::string text = entry.second.IsScalar() ? entry.second.Scalar() : "";
      const std::optional<double> error = ParseNumber(text);
      if (text != "failed" && !(error && *error > 0.0 && *error < 100.0)) {
        Fail(entry.second, "the error of '" + system +
                               "' must be a number of metres from 0 to 100, or 'failed', not '" +
                               text + "'");
      }
      if (!sequence->errors.emplace(system, text == "failed" ? std::nullopt : error).second) {
        Fail(entry.first, "'" + system + "' is given twice");
      }
    }
  }

  std::string file_;
  std::map<std::string, std::string> urls_;  // of the datasets
  std::set<std::string> systems_;
};

}  // namespace

PublishedTable ReadPublishedTable(const std::string& path) { return TableReader(path).Read(); }

}  // namespace msc_vo
