// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// Whether a regular file has the header of a map. Whether it is damaged is not tested.
bool IsMapFile(const std::string& path);

/// Reads a map (docs/map_file.md). What it depends on is recomputed: observations, descriptors and
/// viewing directions of landmarks. Throws std::runtime_error that names the file, the problem and
/// the fix if it is missing, no map, damaged, of a newer version, or written by a run right now.
MapContents LoadMap(const std::string& path);

/// Throws as LoadMap() if the file is not a map without damage; also checks what that does not
/// read.
void CheckMap(const std::string& path);

/// What a map file contains.
struct MapFileSummary {
  struct Session {
    std::string name;
    int64_t num_keyframes = 0;
  };
  struct SubMap {
    int64_t id = 0;
    int64_t num_keyframes = 0;
    int64_t num_points = 0;
    int64_t num_lines = 0;
    int64_t num_planes = 0;
  };
  int version = 0;      ///< of the format
  std::string program;  ///< that wrote it last
  std::vector<Session> sessions;
  std::vector<SubMap> submaps;
  int64_t num_images = 0;      ///< keyframes with an image (MapImages)
  int64_t num_loop_edges = 0;  ///< between keyframes; several for each loop
  int64_t num_bytes = 0;       ///< of the file
};

/// Describes a map without loading it. Throws as LoadMap().
MapFileSummary SummarizeMap(const std::string& path);

}  // namespace msc_vo
