// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/bash_completion.h"

#include <vector>

#include "apps/cli/declarations.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::string OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : VisibleOptions(command)) {
    for (const std::string& name : NamesOf(*option)) names.push_back(name);
  }
  return Joined(names, " ");
}

// Branches of `case $command:$previous` for the options of a command that take a value. A value
// without choices is left to the completion of file names.
std::string ValueCases(const std::string& name, const CLI::App& command) {
  std::string cases;
  for (const CLI::Option* option : VisibleOptions(command)) {
    if (!TakesValue(*option)) continue;
    std::vector<std::string> patterns;
    for (const std::string& option_name : NamesOf(*option)) {
      patterns.push_back(name + ":" + option_name);
    }
    const std::vector<std::string> choices = ChoicesOf(*option);
    cases += "    " + Joined(patterns, "|") + ")\n";
    if (!choices.empty()) {
      cases += "      COMPREPLY=($(compgen -W '" + Joined(choices, " ") + "' -- \"$current\"))\n";
    }
    cases += "      return ;;\n";
  }
  return cases;
}

}  // namespace

std::string FormatBashCompletion(const CLI::App& app) {
  std::vector<std::string> commands;
  std::string values = ValueCases("", app);
  std::string options = "    '') words='" + OptionNames(app);
  std::string option_cases;
  for (const CLI::App* command : VisibleCommands(app)) {
    commands.push_back(command->get_name());
    values += ValueCases(command->get_name(), *command);
    option_cases += "    " + command->get_name() + ") words='" + OptionNames(*command) + "' ;;\n";
  }
  options += " " + Joined(commands, " ") + "' ;;\n" + option_cases;
  return "# Completion of " + app.get_name() +
         " for bash; generated from the declarations of its command line.\n"
         "_msc_vo() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command='' words='' i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case ${COMP_WORDS[i]} in\n"
         "      " +
         Joined(commands, "|") +
         ") command=${COMP_WORDS[i]}; break ;;\n"
         "    esac\n"
         "  done\n"
         "  COMPREPLY=()\n"
         "  case $command:$previous in\n" +
         values +
         "  esac\n"
         "  [[ -n $command && $current != -* ]] && return\n"
         "  case $command in\n" +
         options +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o bashdefault -o default -F _msc_vo " +
         app.get_name() + "\n";
}

}  // namespace msc_vo
