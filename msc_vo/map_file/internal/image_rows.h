// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/map/map_contents.h"
#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

// Table `image` (docs/map_file.md). Maps of versions without it have no images.

/// Writes the image of a keyframe by a statement of PrepareUpsert(database, "image", 3). Throws
/// std::invalid_argument unless `jpeg` is a JPEG file of at most kMaxMapImageBytes.
void WriteImage(KeyframeId id, const std::string& jpeg, SqliteStatement* upsert);

/// Keyframes with an image, ascending.
std::vector<KeyframeId> ListImages(const SqliteDatabase& database);

/// The image of a keyframe; empty without one. Throws std::runtime_error if the row is not valid.
std::string ReadImage(const SqliteDatabase& database, KeyframeId id);

/// Reads all images, one at a time. Throws std::runtime_error if a row is not valid, or is not that
/// of a keyframe of the map.
void CheckImages(const SqliteDatabase& database, const MapContents& contents);

/// Deletes images before the map `contents` replaces another one. Those of keyframes that both
/// maps have are left: keyframes of the same session, which has a name, with the same number and
/// time stamp of the image and descriptors of its features.
void EraseOtherImages(const SqliteDatabase& database, const MapContents& contents);

}  // namespace msc_vo
