// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// The manual page of the whole command, in the man macros of roff.
std::string FormatMainPage(const CLI::App& app);

/// The manual page of a sub-command, "msc_vo-replay(1)".
std::string FormatCommandPage(const CLI::App& app, const CLI::App& command);

}  // namespace msc_vo
