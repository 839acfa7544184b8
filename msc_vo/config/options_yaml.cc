// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Writes options as a YAML file.

#include <algorithm>

#include "msc_vo/config/options_file.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::vector<std::string> SectionsOf(const std::string& path) {
  std::vector<std::string> sections;
  size_t begin = 0;
  for (size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    sections.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  return sections;
}

// A text as a YAML scalar: quoted unless it is a plain name. Bytes are kept, also those that are
// not UTF-8, which the emitter of yaml-cpp replaces.
std::string Quoted(const std::string& text) {
  const auto is_plain = [](char c) { return IsLetterOrDigit(c) || c == '-' || c == '_'; };
  const bool is_name = std::all_of(text.begin(), text.end(), is_plain) && text.front() != '-' &&
                       text != "null" && text != "Null" && text != "NULL";
  if (is_name) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    const bool is_control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    quoted += is_control ? FormatText("\\x%02x", c) : std::string(1, c);
  }
  return quoted + "\"";
}

// Writes options below the keys of their sections.
class YamlWriter {
 public:
  // With comments in a column of their own.
  void WriteExplained(const Option& option) {
    const std::string line = LineOf(option);
    const std::string valid = FormatValidValues(option);
    WriteComment(line, option.help + (valid.empty() ? "" : " [" + valid + "]"));
    if (option.IsBasic()) WriteComment("", option.when_to_change);
  }

  void Write(const Option& option) { text_ += LineOf(option) + "\n"; }

  std::string Take() { return std::move(text_); }

 private:
  static std::string Indent(size_t depth) { return std::string(2 * depth, ' '); }

  // Opens the sections of the option.
  std::string LineOf(const Option& option) {
    OpenSections(SectionsOf(option.path));
    const std::string name = option.path.substr(option.path.rfind('.') + 1);
    std::string value = FormatOption(option);
    const bool is_text = std::holds_alternative<std::string*>(option.value);
    if (is_text && !value.empty()) value = Quoted(value);
    return Indent(open_.size()) + (value.empty() ? "# " : "") + name + ": " + value;
  }

  void OpenSections(const std::vector<std::string>& sections) {
    const auto [end, ignored] =
        std::mismatch(sections.begin(), sections.end(), open_.begin(), open_.end());
    for (auto section = end; section != sections.end(); ++section) {
      text_ += Indent(section - sections.begin()) + *section + ":\n";
    }
    open_ = sections;
  }

  void WriteComment(std::string line, const std::string& comment) {
    constexpr size_t kColumn = 36;  // to the right of most values
    line.resize(std::max(line.size() + 2, kColumn), ' ');
    text_ += line + "# " + comment + "\n";
  }

  std::vector<std::string> open_;  // the sections that the next line is in
  std::string text_;
};

}  // namespace

std::string FormatConfiguration(const Configuration& configuration, OptionSelection selection) {
  Configuration copy = configuration;
  YamlWriter writer;
  for (const Option& option : ListOptions(&copy)) {
    if (selection == OptionSelection::kAll || option.IsBasic()) writer.WriteExplained(option);
  }
  const std::string title =
      selection == OptionSelection::kAll
          ? "# All options of msc_vo.\n"
          : "# The basic options of msc_vo; --print-config --all adds the advanced ones.\n";
  return title + writer.Take();
}

std::string FormatChangedOptions(const Configuration& configuration, const std::string& title) {
  Configuration copy = configuration, defaults;
  const std::vector<Option> options = ListOptions(&copy);
  const std::vector<Option> default_options = ListOptions(&defaults);
  YamlWriter writer;
  for (size_t i = 0; i < options.size(); ++i) {
    if (FormatOption(options[i]) != FormatOption(default_options[i])) writer.Write(options[i]);
  }
  return "# " + title + "\n" + writer.Take();
}

}  // namespace msc_vo
