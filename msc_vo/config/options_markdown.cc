// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Writes the reference of the options as Markdown.

#include "msc_vo/config/options_file.h"

namespace msc_vo {

namespace {

constexpr char kTitle[] =
    "<!-- Generated: msc_vo replay --print-config --all --markdown > docs/options.md -->\n\n"
    "# Options\n\n"
    "Options are set in a YAML file (`--config FILE`), where the parts of a name are nested keys,\n"
    "or on the command line (`--set NAME=VALUE`, which takes precedence). "
    "Unknown names and values\n"
    "out of range are errors. All angles are in degrees. "
    "`msc_vo replay --print-config` prints the\n"
    "basic options as a file for `--config`, `--print-config --all` also the advanced ones.\n\n"
    "The mode takes precedence over options that belong to another mode (a warning names them).\n"
    "`summary.json` and the report of a run contain the options in effect.\n";

std::string Code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

std::string Row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += (cell.empty() ? "" : " " + cell) + " |";
  return row + "\n";
}

std::string Header(const std::vector<std::string>& names) {
  return "\n" + Row(names) + Row(std::vector<std::string>(names.size(), "---"));
}

std::vector<std::string> Cells(const Option& option) {
  return {Code(option.path), Code(FormatOption(option)), FormatValidValues(option), option.help};
}

// The first two parts of the sections of an option: "mapping.axes".
std::string SectionOf(const Option& option) {
  const std::string section = option.path.substr(0, option.path.rfind('.'));
  const size_t dot = section.find('.');
  return dot == std::string::npos ? section : section.substr(0, section.find('.', dot + 1));
}

std::string FormatBasic(const std::vector<Option>& options) {
  std::string text = "\n## Basic options\n" +
                     Header({"Option", "Default", "Values", "Meaning", "When to change it"});
  for (const Option& option : options) {
    if (!option.IsBasic()) continue;
    std::vector<std::string> cells = Cells(option);
    cells.push_back(option.when_to_change);
    text += Row(cells);
  }
  return text;
}

std::string FormatAdvanced(const std::vector<Option>& options) {
  std::string text = "\n## Advanced options\n";
  std::string section;
  for (const Option& option : options) {
    if (option.IsBasic()) continue;
    if (SectionOf(option) != section) {
      section = SectionOf(option);
      text += "\n### " + section + "\n" + Header({"Option", "Default", "Values", "Meaning"});
    }
    text += Row(Cells(option));
  }
  return text;
}

}  // namespace

std::string FormatOptionsMarkdown(OptionSelection selection) {
  Configuration defaults;
  const std::vector<Option> options = ListOptions(&defaults);
  return kTitle + FormatBasic(options) +
         (selection == OptionSelection::kAll ? FormatAdvanced(options) : "");
}

}  // namespace msc_vo
