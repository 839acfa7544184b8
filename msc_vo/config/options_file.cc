// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/options_file.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "msc_vo/config/orb_slam_config.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Assigns the values of a YAML tree to the options of the same names.
class YamlReader {
 public:
  YamlReader(std::string file, std::vector<Option> options)
      : file_(std::move(file)), options_(std::move(options)) {}

  void ReadSection(const YAML::Node& section, const std::string& prefix) {
    for (const auto& entry : section) {
      const std::string path = prefix + entry.first.Scalar();
      const int line = entry.first.Mark().line + 1;
      if (!seen_.insert(path).second) Fail(line, "'" + path + "' is given twice");
      if (IsSection(path)) {
        if (entry.second.IsNull()) continue;
        if (!entry.second.IsMap()) Fail(line, "'" + path + "' is a section; it takes no value");
        ReadSection(entry.second, path + ".");
      } else {
        ReadValue(entry.second, path, line);
      }
    }
  }

  [[noreturn]] void Fail(int line, const std::string& what) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line) + ": " + what);
  }

 private:
  bool IsSection(const std::string& path) const {
    return std::any_of(options_.begin(), options_.end(),
                       [&](const Option& option) { return option.path.rfind(path + ".", 0) == 0; });
  }

  void ReadValue(const YAML::Node& node, const std::string& path, int line) const {
    const Option* option = FindByPath(options_, path);
    if (!option) {
      Fail(line, UnknownOptionMessage(options_, path,
                                      "msc_vo replay --print-config --all lists the known ones"));
    }
    std::string expected = "a value";
    const bool is_list = std::holds_alternative<NumberList>(option->value);
    const bool is_text = is_list ? node.IsSequence() : node.IsScalar();
    const std::string text = is_list ? ListText(node) : node.IsScalar() ? node.Scalar() : "";
    if (!is_text || !SetOption(*option, text, &expected)) {
      if (is_list) SetOption(*option, "", &expected);
      Fail(line, "'" + path + "' must be " + expected +
                     (is_text && !text.empty() ? ", not '" + text + "'" : ""));
    }
  }

  // The scalars of a sequence as text; empty if the node is none.
  static std::string ListText(const YAML::Node& node) {
    std::string text;
    if (!node.IsSequence()) return text;
    for (const YAML::Node& item : node) {
      text += (text.empty() ? "[" : ", ") + (item.IsScalar() ? item.Scalar() : std::string("?"));
    }
    return text + "]";
  }

  std::string file_;
  std::vector<Option> options_;
  std::set<std::string> seen_;
};

}  // namespace

void ReadConfiguration(const std::string& path, Configuration* configuration) {
  const std::string content = ReadText(path, kMaxOptionsBytes);
  if (IsOrbSlamConfig(content)) {
    configuration->camera = ReadOrbSlamConfig(path);
    return;
  }
  YamlReader reader(path, ListOptions(configuration));
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(content);
  } catch (const YAML::Exception& error) {
    reader.Fail(error.mark.line + 1, "malformed YAML: " + error.msg);
  }
  for (size_t i = 1; i < documents.size(); ++i) {
    if (documents[i].IsNull()) continue;  // behind the last '---'
    reader.Fail(documents[i].Mark().line + 1,
                "a second document begins after '---'; write all options in one");
  }
  const YAML::Node root = documents.empty() ? YAML::Node() : documents[0];
  if (!root.IsMap() && !root.IsNull()) reader.Fail(1, "expected 'name: value' lines");
  configuration->camera.origin = path;
  reader.ReadSection(root, "");
}

}  // namespace msc_vo
