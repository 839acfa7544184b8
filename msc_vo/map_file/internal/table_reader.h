// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map_contents.h"
#include "msc_vo/map_file/internal/calibration_rows.h"
#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

/// Reads all tables of a map with a valid schema. Throws std::runtime_error if a row is not valid.
MapContents ReadTables(const SqliteDatabase& database, CalibrationRows* calibrations);

}  // namespace msc_vo
