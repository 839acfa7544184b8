// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/map_input.h"

#include <algorithm>
#include <stdexcept>

#include "msc_vo/map_file/map_reader.h"

namespace msc_vo {

MapContents LoadKeyframes(const std::string& path) {
  MapContents contents = LoadMap(path);
  const bool has_keyframes =
      std::any_of(contents.submaps.begin(), contents.submaps.end(),
                  [](const SavedSubMap& submap) { return !submap.map.keyframes().empty(); });
  if (!has_keyframes) {
    throw std::runtime_error(path + ": has no keyframes; build a map with msc_vo replay --map");
  }
  return contents;
}

}  // namespace msc_vo
