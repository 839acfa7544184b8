// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "msc_vo/frame/plane_feature.h"
#include "msc_vo/map/map_contents.h"
#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

/// The planes of a frame as the blob of table plane_features (docs/map_file.md).
std::string EncodePlanes(const std::vector<PlaneFeature>& planes);
/// Throws BlobError if the bytes are not valid.
std::vector<PlaneFeature> DecodePlanes(std::string_view bytes);

/// Makes table plane contain the planes of all submaps, numbered anew.
void WritePlanes(const SqliteDatabase& database, const MapContents& contents);

/// Table plane_features, by keyframe. Throws std::runtime_error if a row is not valid.
std::map<KeyframeId, std::vector<PlaneFeature>> ReadPlaneFeatures(const SqliteDatabase& database);

/// Reads table plane into submaps whose keyframes have been read. Throws std::runtime_error if a
/// row is not valid.
void ReadPlanes(const SqliteDatabase& database, MapContents* contents);

}  // namespace msc_vo
