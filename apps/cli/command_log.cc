// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/command_log.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include "apps/cli/commands.h"
#include "apps/cli/output_file.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

std::string log_file;  // set once, before any command runs; empty: none

// Throws std::runtime_error if the file is no log, whose lines begin with a bracket, or if another
// argument names it.
void CheckLogFile(const std::string& file) {
  constexpr char kOption[] = "--log-file";
  const auto fail = [&file](const std::string& problem) {
    throw std::runtime_error("--log-file " + file + ": " + problem + "; give another path");
  };
  const bool exists = FileProblem(file, std::numeric_limits<std::uintmax_t>::max()).empty();
  const std::string first = exists ? ReadBeginning(file, 1) : "";
  if (!first.empty() && first != "[") fail("exists and is no log");
  std::string before;
  for (const std::string& argument : CommandArguments()) {
    const bool is_own = before == kOption || argument.rfind(kOption + std::string("="), 0) == 0;
    before = argument;
    if (is_own) continue;
    std::string value = argument;
    if (AreSameFile(value, file)) fail("is also the path of another argument");
    for (size_t i = value.find('='); i != std::string::npos; i = value.find('=')) {
      value = value.substr(i + 1);
      if (AreSameFile(value, file)) fail("is also the path of another argument");
    }
  }
}

spdlog::sink_ptr MakeSink(const std::string& file) {
  if (file.empty()) return std::make_shared<spdlog::sinks::stderr_sink_mt>();
  try {
    return std::make_shared<spdlog::sinks::basic_file_sink_mt>(file);
  } catch (const spdlog::spdlog_ex& error) {
    throw std::runtime_error("--log-file " + file + ": " + error.what());
  }
}

// Called by the thread whose line could not be written.
void EndLog(const std::string& file, const std::string& problem) {
  static std::atomic<bool> has_ended{false};
  Log().set_level(spdlog::level::off);
  if (has_ended.exchange(true)) return;
  PrintWarning((file.empty() ? "standard error" : file) + ": the log ends here: " + problem);
}

std::string Environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

// Whether text on standard error may be coloured: it is a terminal other than "dumb", and the
// environment variable NO_COLOR is not set or empty (https://no-color.org).
bool HasColors() {
  return isatty(STDERR_FILENO) == 1 && Environment("NO_COLOR").empty() &&
         Environment("TERM") != "dumb";
}

void Print(spdlog::level::level_enum level, const std::string& text) {
  constexpr char kRed[] = "\x1b[31m", kYellow[] = "\x1b[33m", kEnd[] = "\x1b[0m";
  const bool is_warning = level == spdlog::level::warn;
  std::string label = is_warning ? "warning:" : "error:";
  if (HasColors()) label = (is_warning ? kYellow : kRed) + label + kEnd;
  std::cerr << "msc_vo: " << label << " " << text << std::endl;
  if (!log_file.empty()) Log().log(level, text);
}

}  // namespace

void AddLogArguments(CLI::App* command, LogArguments* arguments) {
  command
      ->add_option("--log-level", arguments->level,
                   "Log events of this level and above; default: off, with --log-file info")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->group("Log");
  command
      ->add_option("--log-file", arguments->file,
                   "Append the log to this file instead of writing it to standard error")
      ->group("Log");
}

void StartLog(const LogArguments& arguments) {
  const std::string default_level = arguments.file.empty() ? "off" : "info";
  const spdlog::level::level_enum level =
      spdlog::level::from_str(arguments.level.empty() ? default_level : arguments.level);
  if (level == spdlog::level::off) return;
  if (!arguments.file.empty()) CheckLogFile(arguments.file);
  Log().sinks() = {MakeSink(arguments.file)};
  Log().set_level(level);
  Log().set_error_handler(
      [file = arguments.file](const std::string& problem) { EndLog(file, problem); });
  if (!arguments.file.empty()) log_file = std::filesystem::absolute(arguments.file).string();
}

const std::string& LogFile() { return log_file; }

void PrintWarning(const std::string& text) { Print(spdlog::level::warn, text); }

void PrintError(const std::string& text) { Print(spdlog::level::err, text); }

void PrintWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) PrintWarning(warning);
}

}  // namespace msc_vo
