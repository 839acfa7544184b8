// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/map_argument.h"

#include <stdexcept>

#include "msc_vo/map_file/map_reader.h"

namespace msc_vo {

void RefuseMapFile(const std::string& path, const std::string& fix) {
  if (IsMapFile(path)) throw std::runtime_error(path + ": is a map file; " + fix);
}

}  // namespace msc_vo
