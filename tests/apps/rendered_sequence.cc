// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/apps/rendered_sequence.h"

#include <filesystem>
#include <functional>
#include <stdexcept>

#include "tests/apps/command_process.h"
#include <unistd.h>

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Sequences of this build of the command; those of older builds are deleted.
fs::path CacheOfBuild() {
  const fs::path all = MSC_VO_RENDERED_FOLDER;
  const fs::path command = MSC_VO_COMMAND;
  const std::string build = std::to_string(fs::file_size(command)) + "-" +
                            std::to_string(fs::last_write_time(command).time_since_epoch().count());
  if (fs::create_directories(all / build)) {
    for (const auto& entry : fs::directory_iterator(all)) {
      if (entry.path().filename() != build) fs::remove_all(entry.path());
    }
  }
  return all / build;
}

}  // namespace

void RenderSequence(const std::string& folder, const std::vector<std::string>& arguments) {
  std::string all;
  for (const std::string& argument : arguments) all += argument + '\n';
  const fs::path rendered = CacheOfBuild() / std::to_string(std::hash<std::string>()(all));
  if (!fs::exists(rendered)) {
    const fs::path own = rendered.string() + "-" + std::to_string(getpid());
    std::vector<std::string> command = {"synthesize", own.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const CommandOutcome outcome = RunCommand(command);
    if (outcome.exit_code != 0) throw std::runtime_error(outcome.output);
    std::error_code exists;
    fs::rename(own, rendered, exists);  // another test may have rendered it meanwhile
    if (exists) fs::remove_all(own);
  }
  fs::create_directories(folder);
  fs::copy(rendered, folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
}

}  // namespace msc_vo
