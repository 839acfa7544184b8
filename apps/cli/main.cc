// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <opencv2/core/utility.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/standard_streams.h"
#include "msc_vo/text/shell_word.h"
#include "msc_vo/text/similar_name.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/version.h"

namespace msc_vo {

std::string HelpFooter(const std::string& example) {
  return "Example:\n  " + example +
         "\n\nExit codes: 0 success, 1 invalid input or failed run, 2 invalid command line,\n"
         "3 tracking failed: less than half of the images have an estimated pose (results are\n"
         "written), 130 interrupted (results so far are written).";
}

namespace {

// Both are set once, before any command runs.
std::string command_line;
std::vector<std::string> command_arguments;

using AddCommand = Command (*)(CLI::App*);
constexpr AddCommand kCommands[] = {
    AddReplayCommand,    AddEvaluateCommand, AddBenchmarkCommand,  AddCheckCommand,
    AddCalibrateCommand, AddRecordCommand,   AddSynthesizeCommand, AddSolveWindowCommand,
    AddFuseCommand,      AddMapCommand,      AddExportCommand,     AddGenerateCommand};

// Images and matrices of several megabytes are allocated and freed in every frame. By default the C
// library returns such blocks to the system at once, and page faults on the next allocation cost
// 1 ms per frame. With an arena per thread, each thread would keep freed memory of its own, see
// docs/lab/performance.md.
void KeepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the maximum
  mallopt(M_TRIM_THRESHOLD, 64 << 20);  // more than a frame and a local BA need
#endif
}

// The odometry divides a frame into tasks itself. The threads of OpenCV spin between its small work
// items, which costs 2 to 3 ms of processor time per frame.
void DisableOpenCvThreads() { cv::setNumThreads(1); }

// Damaged images are reported by the commands, with the names of their files.
void SilenceOpenCv() {
  if (std::getenv("OPENCV_LOG_LEVEL") != nullptr) return;
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

// Throws if the first argument is neither an option nor a sub-command.
void CheckSubcommand(const std::vector<Command>& commands, const std::string& name) {
  if (name.rfind('-', 0) == 0) return;
  std::vector<std::string> names;
  for (const Command& command : commands) {
    if (command.arguments->get_name() == name) return;
    if (command.arguments->get_group().empty()) continue;  // hidden
    names.push_back(command.arguments->get_name());
  }
  const std::optional<std::string> similar = FindSimilarName(names, name);
  throw CLI::ExtrasError("msc_vo: error: unknown command '" + name + "'" +
                             (similar ? "; did you mean '" + *similar + "'?" : "") +
                             "\nCommands: " + Joined(names, ", "),
                         CLI::ExitCodes::ExtrasError);
}

int Main(int argc, char** argv) {
  for (int i = 0; i < argc; ++i) command_line += (i > 0 ? " " : "") + ShellWord(argv[i]);
  command_arguments.assign(argv + std::min(argc, 1), argv + argc);
  CLI::App app("RGB-D visual odometry from points, lines and the structure of the scene", "msc_vo");
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("msc_vo ") + kVersion);
  app.footer(HelpFooter("msc_vo replay my_sequence --output out"));
  LogArguments log;
  AddLogArguments(&app, &log);
  std::vector<Command> commands;
  for (const AddCommand add : kCommands) {
    commands.push_back(add(&app));
    AddLogArguments(commands.back().arguments, &log);
  }

  try {
    if (argc > 1) CheckSubcommand(commands, argv[1]);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  StartLog(log);
  for (const Command& command : commands) {
    if (command.arguments->parsed()) return command.run();
  }
  return kExitUsage;
}

}  // namespace

const std::string& CommandLine() { return command_line; }

const std::vector<std::string>& CommandArguments() { return command_arguments; }

}  // namespace msc_vo

int main(int argc, char** argv) {
  msc_vo::KeepFreedMemory();
  setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0);  // before there are other threads
  msc_vo::DisableOpenCvThreads();
  msc_vo::SilenceOpenCv();
  msc_vo::PrepareStandardStreams();
  try {
    const int exit_code = msc_vo::Main(argc, argv);
    msc_vo::FinishStandardOutput();
    return exit_code;
  } catch (const msc_vo::Interrupted& error) {
    msc_vo::PrintWarning(error.what());
    return msc_vo::kExitInterrupted;
  } catch (const msc_vo::UsageError& error) {
    msc_vo::PrintError(error.what());
    return msc_vo::kExitUsage;
  } catch (const std::exception& error) {
    msc_vo::PrintError(error.what());
    return msc_vo::kExitError;
  }
}
