// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// Writes a map file while a map is built. Other processes cannot use the file as long as this
/// object exists. If the process is killed, the file has the contents of the last Write().
class MapWriter {
 public:
  /// Opens a map, or creates an empty one. Throws std::runtime_error that names the file, the
  /// problem and the fix if the file is no map, is damaged or of a newer version, cannot be
  /// written, or is in use.
  explicit MapWriter(const std::string& path);
  ~MapWriter();

  /// The map in the file; without submaps if it is new. Throws as LoadMap(). Call it before
  /// Write(), which otherwise replaces what the file contains.
  MapContents Load();

  /// Makes the file contain this map, and writes only what has changed since the last call or
  /// Load(): the maps must share their memory (Map::Share()) with those. Throws
  /// std::runtime_error, and WriteError if the file cannot be written; the file then remains as it
  /// was.
  void Write(MapContents contents);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a map. Replaces the map that the file contains, if there is one.
void SaveMap(const std::string& path, MapContents contents);

}  // namespace msc_vo
