// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/map_mark.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "msc_vo/text/files.h"

namespace msc_vo {

void RefuseMapFile(const std::string& path, const std::string& fix) {
  const std::string sqlite("SQLite format 3\0", 16), application = "MSCV";  // docs/map_file.md
  constexpr size_t kApplicationOffset = 68;  // of the id in the header of SQLite
  std::error_code error;                     // pipes would wait for a writer
  if (!std::filesystem::is_regular_file(path, error)) return;
  const std::string header = ReadBeginning(path, kApplicationOffset + application.size());
  if (header.compare(0, sqlite.size(), sqlite) != 0 || header.size() < kApplicationOffset) return;
  if (header.compare(kApplicationOffset, std::string::npos, application) != 0) return;
  throw std::runtime_error(path + ": is a map file; " + fix);
}

}  // namespace msc_vo
