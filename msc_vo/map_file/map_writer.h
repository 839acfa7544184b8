// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/map/map_contents.h"
#include "msc_vo/map_file/map_images.h"

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
  /// Load(): the maps must share their memory (Map::Share()) with those. `images` is asked for the
  /// image of each keyframe whose frame is new to the file; where it has none, the file keeps the
  /// image that it has. Throws std::runtime_error, WriteError if the file cannot be written, and
  /// std::invalid_argument if an image is no JPEG file or larger than kMaxMapImageBytes; the file
  /// then remains as it was.
  void Write(MapContents contents, const KeyframeImageSource& images = {});

  /// The image of a keyframe in the file; empty without one. Throws as LoadMap().
  std::string ReadImage(KeyframeId id) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a map. Replaces the map that the file contains, if there is one; the file keeps the
/// images of keyframes that are also in `contents` (same session, which has a name, same number and
/// time stamp of the image, and at least half of the features have descriptors of the one in the
/// file). Throws as MapWriter.
void SaveMap(const std::string& path, MapContents contents, const KeyframeImageSource& images = {});

}  // namespace msc_vo
