// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace msc_vo {

// The declarations of the command line as text, for its documentation.

/// The sub-commands that --help lists, in its order.
std::vector<const CLI::App*> VisibleCommands(const CLI::App& app);

/// The options and flags that --help lists, in its order; positional arguments are not among them.
std::vector<const CLI::Option*> VisibleOptions(const CLI::App& app);
std::vector<const CLI::Option*> PositionalArguments(const CLI::App& app);

/// "--name" and "-n", long names first.
std::vector<std::string> NamesOf(const CLI::Option& option);

/// Whether a value follows the option.
bool TakesValue(const CLI::Option& option);

/// The values that an option accepts; empty unless it is an enumeration.
std::vector<std::string> ChoicesOf(const CLI::Option& option);

}  // namespace msc_vo
