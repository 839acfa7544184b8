// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace msc_vo {

// A process of the msc_vo binary. Captures standard output and standard error together, or only
// standard error if `stdout_path` names a file or a device for standard output.
class CommandProcess {
 public:
  explicit CommandProcess(const std::vector<std::string>& arguments,
                          const std::string& stdout_path = "");
  // Waits for the program to end.
  ~CommandProcess();
  CommandProcess(const CommandProcess&) = delete;
  CommandProcess& operator=(const CommandProcess&) = delete;

  // Reads until the output contains `text`. Returns false if the program ends without it.
  bool WaitForOutput(const std::string& text);
  void Signal(int signal);
  // Closes the reading end of the pipe.
  void CloseOutput();
  // Reads until the program ends. Returns its exit code, or minus the signal that ended it.
  int Wait();

  const std::string& output() const { return output_; }

 private:
  bool ReadSome();

  pid_t pid_ = -1;
  int pipe_ = -1;
  bool is_running_ = true;
  int exit_code_ = 0;
  std::string output_;
};

struct CommandOutcome {
  int exit_code = 0;
  std::string output;
};

CommandOutcome RunCommand(const std::vector<std::string>& arguments,
                          const std::string& stdout_path = "");

}  // namespace msc_vo
