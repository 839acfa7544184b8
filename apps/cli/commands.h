// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace msc_vo {

/// Exit codes of the msc_vo command, documented in the --help of every sub-command.
enum ExitCode {
  kExitSuccess = 0,
  kExitError = 1,           ///< invalid input or failed run
  kExitUsage = 2,           ///< invalid command line
  kExitTrackingFailed = 3,  ///< fewer images than kMinTrackedRatio have an estimated pose
  kExitInterrupted = 130,   ///< by SIGINT, SIGTERM or SIGHUP; results so far are written
};

/// An error of the command line that is found after it was parsed. The command ends with
/// kExitUsage.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Footer of a sub-command's --help: an example and the exit codes.
std::string HelpFooter(const std::string& example);

/// The command line, quoted for a shell.
const std::string& CommandLine();
/// Its arguments behind the name of the program.
const std::vector<std::string>& CommandArguments();

/// A sub-command: the declaration of its arguments and the function that executes it.
///
/// `run` returns an ExitCode. It reports an error by an exception, which main prints as
/// "msc_vo: error: ..." before it exits with kExitError, or with kExitUsage for a UsageError.
struct Command {
  CLI::App* arguments = nullptr;
  std::function<int()> run;
};

// One function and one file per sub-command.
Command AddReplayCommand(CLI::App* app);
Command AddEvaluateCommand(CLI::App* app);
Command AddBenchmarkCommand(CLI::App* app);
Command AddSynthesizeCommand(CLI::App* app);
Command AddCalibrateCommand(CLI::App* app);
Command AddCheckCommand(CLI::App* app);
Command AddRecordCommand(CLI::App* app);
Command AddSolveWindowCommand(CLI::App* app);
Command AddFuseCommand(CLI::App* app);
Command AddMapCommand(CLI::App* app);
Command AddExportCommand(CLI::App* app);
Command AddGenerateCommand(CLI::App* app);  ///< hidden: manual pages and completion

}  // namespace msc_vo
