// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/man_page.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include "apps/cli/declarations.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

// Text in which roff sees neither requests nor escapes, and hyphens can be copied.
std::string Escape(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const bool begins_line = escaped.empty() || escaped.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string Bold(const std::string& text) { return "\\fB" + Escape(text) + "\\fR"; }
std::string Italic(const std::string& text) { return "\\fI" + Escape(text) + "\\fR"; }

std::string Title(const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return ".TH \"" + Escape(upper) + "\" \"1\" \"\" \"msc_vo " + kVersion + "\" \"User Commands\"\n";
}

// "msc_vo-replay", the name of a page.
std::string PageName(const CLI::App& app, const CLI::App& command) {
  return app.get_name() + "-" + command.get_name();
}

// The kind of value that follows an option, in lower case: "float", or its choices.
std::string ValueText(const CLI::Option& option) {
  const std::vector<std::string> choices = ChoicesOf(option);
  if (!choices.empty()) {
    std::string text;
    // A line may end behind each bar.
    for (const std::string& choice : choices) text += (text.empty() ? "" : "|\\:") + Italic(choice);
    return text;
  }
  const std::string type = option.get_type_name();
  return Italic(CLI::detail::to_lower(type.substr(0, type.find(':'))));
}

// One option with its names, value, description and default.
std::string OptionParagraph(const CLI::Option& option) {
  std::string names;
  if (option.nonpositional()) {
    for (const std::string& name : NamesOf(option)) {
      names += (names.empty() ? "" : ", ") + Bold(name);
    }
    if (TakesValue(option)) names += " " + ValueText(option);
  } else {
    names = Italic(option.get_name(true));
  }
  std::string text = ".TP\n" + names + "\n" + Escape(option.get_description());
  if (!option.get_default_str().empty()) {
    text += "; default: " + Escape(option.get_default_str());
  }
  return text + "\n";
}

std::string OptionsSection(const CLI::App& command) {
  std::string text = ".SH OPTIONS\n";
  for (const CLI::Option* option : VisibleOptions(command)) text += OptionParagraph(*option);
  return text;
}

std::string Verbatim(const std::string& text) {
  return ".RS 4\n.nf\n" + Escape(text) + "\n.fi\n.RE\n";
}

// The paragraphs of a footer: the example, the exit codes, and notes.
std::string FooterSections(const std::string& footer) {
  const std::string example = "Example:\n", exit_codes = "Exit codes: ";
  std::string notes, others;
  size_t begin = 0;
  while (begin < footer.size()) {
    const size_t end = std::min(footer.find("\n\n", begin), footer.size());
    const std::string paragraph = footer.substr(begin, end - begin);
    begin = end + 2;
    if (paragraph.rfind(example, 0) == 0) {
      others +=
          ".SH EXAMPLES\n" + Verbatim(CLI::detail::trim_copy(paragraph.substr(example.size())));
    } else if (paragraph.rfind(exit_codes, 0) == 0) {
      others += ".SH EXIT STATUS\n" + Escape(paragraph.substr(exit_codes.size())) + "\n";
    } else {
      notes += ".SH NOTES\n" + Escape(paragraph) + "\n";
    }
  }
  return notes + others;
}

std::string SeeAlso(const CLI::App& app, const std::string& own_name) {
  std::vector<std::string> names = {app.get_name()};
  for (const CLI::App* command : VisibleCommands(app)) names.push_back(PageName(app, *command));
  names.erase(std::find(names.begin(), names.end(), own_name));
  std::string text;
  for (const std::string& name : names) {
    text += ".BR " + Escape(name) + " (1)" + (name == names.back() ? "\n" : ",\n");
  }
  return ".SH SEE ALSO\n" + text;
}

}  // namespace

std::string FormatMainPage(const CLI::App& app) {
  std::string text = Title(app.get_name()) + ".SH NAME\n" + Escape(app.get_name()) + " \\- " +
                     Escape(app.get_description()) + "\n.SH SYNOPSIS\n" + Bold(app.get_name()) +
                     " [" + Italic("options") + "] " + Italic("command") + " ...\n" +
                     ".SH COMMANDS\n";
  for (const CLI::App* command : VisibleCommands(app)) {
    text += ".TP\n" + Bold(command->get_name()) + "\n" + Escape(command->get_description()) + "\n";
  }
  return text + OptionsSection(app) + FooterSections(app.get_footer()) +
         SeeAlso(app, app.get_name());
}

std::string FormatCommandPage(const CLI::App& app, const CLI::App& command) {
  const std::string name = PageName(app, command);
  std::string synopsis =
      Bold(app.get_name() + " " + command.get_name()) + " [" + Italic("options") + "]";
  std::string arguments;
  for (const CLI::Option* argument : PositionalArguments(command)) {
    const std::string shown =
        Italic(argument->get_name(true)) + (argument->get_expected_max() > 1 ? " ..." : "");
    synopsis += argument->get_required() ? " " + shown : " [" + shown + "]";
    arguments += OptionParagraph(*argument);
  }
  return Title(name) + ".SH NAME\n" + Escape(name) + " \\- " + Escape(command.get_description()) +
         "\n.SH SYNOPSIS\n" + synopsis + "\n" +
         (arguments.empty() ? "" : ".SH ARGUMENTS\n" + arguments) + OptionsSection(command) +
         FooterSections(command.get_footer()) + SeeAlso(app, name);
}

}  // namespace msc_vo
