// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// A script for bash that completes sub-commands, options and the values of enumerations; other
/// words are completed as files.
std::string FormatBashCompletion(const CLI::App& app);

}  // namespace msc_vo
