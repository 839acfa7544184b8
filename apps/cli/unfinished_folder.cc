// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/unfinished_folder.h"

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Creates the folder. Returns false if it exists.
bool Create(const fs::path& folder) {
  std::error_code error;
  const bool is_new = fs::create_directory(folder, error);
  if (!error) return is_new;
  const std::string parent = folder.parent_path().string();
  throw std::runtime_error((parent.empty() ? "." : parent) + ": cannot be written: " +
                           ErrorText(error) + "; check its permissions, or give another path");
}

// Throws unless a folder is what is left of an UnfinishedFolder: one with its mark, or empty if the
// process was killed at once.
void RequireOwn(const fs::path& folder) {
  std::error_code error;
  if (HasEntry((folder / UnfinishedFolder::kMark).string()) || fs::is_empty(folder, error)) return;
  throw std::runtime_error(folder.string() +
                           ": exists, and is not left from an unfinished msc_vo map; remove it, or "
                           "give another path");
}

}  // namespace

UnfinishedFolder::UnfinishedFolder(const std::string& path) : path_(path) {
  const bool is_new = Create(path);
  if (!is_new) RequireOwn(path);
  const std::string mark = File(kMark);
  lock_ = open(mark.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (lock_ < 0) {
    const std::error_code error(errno, std::generic_category());
    throw std::runtime_error(mark + ": cannot be opened: " + ErrorText(error) + "; remove " + path);
  }
  // The system releases the lock of a process that was killed. Some file systems have no locks.
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || !is_new)) {
    const bool is_used = errno == EWOULDBLOCK;
    close(lock_);
    throw std::runtime_error(
        is_used ? path + ": another process writes into it; wait until that has ended"
                : path + ": exists; remove it if no other process writes into it");
  }
  if (is_new) return;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    std::error_code ignored;
    if (entry.path().filename() != kMark) fs::remove_all(entry.path(), ignored);
  }
  // Another process may have removed the folder between the calls.
  if (!error && HasEntry(mark)) return;
  close(lock_);
  throw std::runtime_error(path + ": was removed by another process; try again");
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  close(lock_);
}

std::string UnfinishedFolder::File(const std::string& name) const { return PathIn(path_, name); }

}  // namespace msc_vo
