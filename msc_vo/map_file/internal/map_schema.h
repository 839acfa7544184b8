// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>

#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

/// "MSCV" in the header of a map.
constexpr uint32_t kApplicationId = 0x4d534356;
/// Version of the tables, docs/map_file.md.
constexpr int kMapFileVersion = 5;
/// The first version with the tables of planes.
constexpr int kFirstVersionWithPlanes = 2;
/// The first version with the table of landmarks whose depth is false.
constexpr int kFirstVersionWithFalseDepths = 3;
/// The first version with the table of images.
constexpr int kFirstVersionWithImages = 4;

/// Largest ids of keyframes and landmarks, because the memory of some algorithms grows with them: a
/// year of keyframes, and a hundred landmarks for each.
constexpr int64_t kMaxKeyframes = int64_t{1} << 26;
constexpr int64_t kMaxLandmarks = int64_t{1} << 33;

/// Whether the file has no tables at all: it is new, or a run was killed before it wrote anything.
bool IsEmptyDatabase(const SqliteDatabase& database);

/// Makes the tables in an empty file.
void CreateSchema(const SqliteDatabase& database);

/// The version of a map.
int SchemaVersion(const SqliteDatabase& database);

/// Changes the tables of a map of an older version to those of this one. Tables that every write
/// replaces are left empty if their columns change.
void UpgradeSchema(const SqliteDatabase& database);

/// Throws std::runtime_error unless the file is a map of a version that this program reads.
void CheckSchema(const SqliteDatabase& database);

}  // namespace msc_vo
