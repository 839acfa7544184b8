// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// Arguments that configure the log.
struct LogArguments {
  std::string level;  ///< empty: "info" with a file, otherwise "off"
  std::string file;   ///< empty: standard error
};

/// Declares --log-level and --log-file.
void AddLogArguments(CLI::App* command, LogArguments* arguments);

/// Configures the logger of the library. Lines are appended to the file. Throws std::runtime_error
/// naming the file if it cannot be written, exists and is no log, or is another argument of the
/// command.
void StartLog(const LogArguments& arguments);

/// The absolute path of the log file; empty if there is none.
const std::string& LogFile();

/// Print "msc_vo: warning: ..." or "msc_vo: error: ..." on standard error and add the text to the
/// log file, if there is one.
void PrintWarning(const std::string& text);
void PrintError(const std::string& text);
void PrintWarnings(const std::vector<std::string>& warnings);

}  // namespace msc_vo
