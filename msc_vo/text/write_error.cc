// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/write_error.h"

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

std::string Describe(const std::string& path, int cause) {
  return path + ": cannot be written" +
         (cause != 0 ? ": " + ErrorText({cause, std::generic_category()}) : std::string()) +
         " (check the folder and the free space)";
}

}  // namespace

WriteError::WriteError(const std::string& path, int cause)
    : std::runtime_error(Describe(path, cause)), lacks_space_(cause == ENOSPC || cause == EDQUOT) {}

bool WouldFit(const std::string& folder, std::uintmax_t num_removed, std::uintmax_t num_bytes) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return error || space.available + num_removed >= num_bytes;
}

void WriteWithRoom(const std::function<void()>& write, std::uintmax_t num_bytes,
                   const MakeRoom& make_room) {
  while (true) {
    try {
      return write();
    } catch (const WriteError& error) {
      if (!error.LacksSpace() || !make_room(num_bytes)) throw;
    }
  }
}

}  // namespace msc_vo
