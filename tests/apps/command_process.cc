// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/command_process.h"

#include <csignal>
#include <stdexcept>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace msc_vo {

CommandProcess::CommandProcess(const std::vector<std::string>& arguments,
                               const std::string& stdout_path) {
  std::vector<char*> argv = {const_cast<char*>(MSC_VO_COMMAND)};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("pipe failed");
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    const int out = stdout_path.empty() ? ends[1] : open(stdout_path.c_str(), O_WRONLY);
    dup2(out, STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    close(ends[0]);
    close(ends[1]);
    execv(MSC_VO_COMMAND, argv.data());
    _exit(127);
  }
  close(ends[1]);
  pipe_ = ends[0];
}

CommandProcess::~CommandProcess() {
  Wait();
  if (pipe_ >= 0) CloseOutput();
}

bool CommandProcess::ReadSome() {
  char buffer[4096];
  const ssize_t count = read(pipe_, buffer, sizeof(buffer));
  if (count > 0) output_.append(buffer, static_cast<size_t>(count));
  return count > 0;
}

bool CommandProcess::WaitForOutput(const std::string& text) {
  while (output_.find(text) == std::string::npos) {
    if (!ReadSome()) return false;
  }
  return true;
}

void CommandProcess::CloseOutput() {
  close(pipe_);
  pipe_ = -1;
}

void CommandProcess::Signal(int signal) { kill(pid_, signal); }

int CommandProcess::Wait() {
  if (!is_running_) return exit_code_;
  while (ReadSome()) {
  }
  int status = 0;
  waitpid(pid_, &status, 0);
  is_running_ = false;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return exit_code_;
}

CommandOutcome RunCommand(const std::vector<std::string>& arguments,
                          const std::string& stdout_path) {
  CommandProcess process(arguments, stdout_path);
  const int exit_code = process.Wait();
  return {exit_code, process.output()};
}

}  // namespace msc_vo
