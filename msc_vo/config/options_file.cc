// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/options_file.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

#include <yaml-cpp/yaml.h>

#include "msc_vo/config/orb_slam_config.h"
#include "msc_vo/datasets/camera_file.h"
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

// Throws if the file is a calibration as ROS, OpenCV or Open3D write it.
void RefuseOtherCalibrations(const YAML::Node& root, const YamlReader& reader) {
  for (const auto& entry : root) {
    const std::string& name = entry.first.Scalar();
    if (name != "camera_matrix" && name != "intrinsic_matrix") continue;
    reader.Fail(entry.first.Mark().line + 1,
                "'" + name + "' is a calibration of another program; write its numbers as a " +
                    "camera.txt, " + kCameraFileFormat);
  }
}

// Returns the line with '---' or '...' between two documents that are not empty; 0 if there is only
// one. yaml-cpp reads the first one alone, and does not end for some malformed texts if it is asked
// for all.
int SecondDocument(const std::string& content) {
  std::istringstream lines(content);
  std::string line;
  bool has_content = false;
  int marker = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string start = line.substr(0, 3);
    const bool is_marker = (start == "---" || start == "...") &&
                           (line.size() == 3 || std::isspace(static_cast<unsigned char>(line[3])));
    if (is_marker && has_content) marker = number;
    const std::string text = Trimmed(is_marker ? line.substr(3) : line);
    if (text.empty() || text[0] == '#' || text[0] == '%') continue;
    if (marker > 0) return marker;
    has_content = true;
  }
  return 0;
}

}  // namespace

void ReadConfiguration(const std::string& path, Configuration* configuration) {
  const std::string content = ReadText(path, kMaxOptionsBytes);
  if (IsOrbSlamConfig(content)) {
    configuration->camera = ReadOrbSlamConfig(path);
    return;
  }
  YamlReader reader(path, ListOptions(configuration));
  if (const int line = SecondDocument(content); line > 0) {
    reader.Fail(line, "a second document begins; write all options in one");
  }
  YAML::Node root;
  try {
    root = YAML::Load(content);
  } catch (const YAML::Exception& error) {
    reader.Fail(error.mark.line + 1, "malformed YAML: " + error.msg);
  }
  if (!root.IsMap() && !root.IsNull()) reader.Fail(1, "expected 'name: value' lines");
  RefuseOtherCalibrations(root, reader);
  configuration->camera.origin = path;
  reader.ReadSection(root, "");
}

}  // namespace msc_vo
