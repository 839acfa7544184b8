// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/run_files.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <system_error>

#include <sys/stat.h>

#include "apps/cli/command_log.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {

namespace {

bool AreOnOneDisk(const std::string& a, const std::string& b) {
  struct stat status_of_a = {}, status_of_b = {};
  return stat(a.c_str(), &status_of_a) == 0 && stat(b.c_str(), &status_of_b) == 0 &&
         status_of_a.st_dev == status_of_b.st_dev;
}

// Bytes of a file, or of the files in a folder.
std::uintmax_t NumBytes(const std::string& path) {
  std::uintmax_t num_bytes = 0;
  if (!IsFolder(path)) {
    std::error_code error;
    num_bytes = std::filesystem::file_size(path, error);
    return error ? 0 : num_bytes;
  }
  for (const std::string& entry : ListFolder(path)) num_bytes += NumBytes(entry);
  return num_bytes;
}

}  // namespace

void RunFiles::AddExpendable(const std::string& path, std::function<std::string()> remove) {
  expendable_.push_back({path, std::move(remove)});
}

void RunFiles::Add(const FrameResult& frame) {
  try {
    online_.Add(frame);
  } catch (const std::exception& error) {
    if (!has_warned_) {
      PrintWarning(std::string(error.what()) +
                   "; the run goes on, and its results are written at its end");
    }
    has_warned_ = true;
  }
}

std::string RunFiles::Finish(const OdometryResult& result, const RunContext& context) {
  return WriteResultFiles(directory_, result, context,
                          [this](std::uintmax_t num_bytes) { return MakeRoomFor(num_bytes); });
}

bool RunFiles::MakeRoomFor(std::uintmax_t num_bytes) {
  const auto is_elsewhere = [this](const Expendable& expendable) {
    return !AreOnOneDisk(expendable.path, directory_);
  };
  EraseIf(&expendable_, is_elsewhere);
  std::uintmax_t num_removed = 0;
  for (const Expendable& expendable : expendable_) num_removed += NumBytes(expendable.path);
  if (!WouldFit(directory_, num_removed, num_bytes)) return false;
  while (!expendable_.empty()) {
    const std::string removed = expendable_.front().remove();
    expendable_.erase(expendable_.begin());
    if (removed.empty()) continue;
    PrintWarning("the disk is full: " + removed + " has been removed, so that the results fit");
    return true;
  }
  return false;
}

}  // namespace msc_vo
