// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace msc_vo {

// Exit codes of the msc_vo command; every sub-command's --help ends with them.
enum ExitCode {
  kExitSuccess = 0,
  kExitError = 1,           // the input is wrong or the run failed; the message says which
  kExitUsage = 2,           // the command line is wrong
  kExitTrackingFailed = 3,  // the run ended, but less than kMinTrackedShare of it was tracked
  kExitInterrupted = 130,   // Ctrl-C, SIGTERM, SIGHUP; the results so far have been written
};

// Footer of a sub-command's --help: an example, then the exit codes.
std::string HelpFooter(const std::string& example);

// The command line as it was typed, for the records of a run.
const std::string& CommandLine();

// One sub-command: where its arguments are declared, and what runs if the user chose it.
//
// `run` returns an ExitCode and reports failure by throwing std::exception: main prints
// "msc_vo: error: ..." and exits with kExitError. Nothing but main calls exit().
struct Command {
  CLI::App* arguments = nullptr;
  std::function<int()> run;
};

// Each adds its sub-command to `app`; one file per sub-command.
Command AddReplayCommand(CLI::App* app);
Command AddEvaluateCommand(CLI::App* app);
Command AddBenchmarkCommand(CLI::App* app);
Command AddSynthesizeCommand(CLI::App* app);
Command AddCheckCommand(CLI::App* app);
Command AddSolveWindowCommand(CLI::App* app);

}  // namespace msc_vo
