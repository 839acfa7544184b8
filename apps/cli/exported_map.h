// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "apps/cli/run_export.h"

namespace msc_vo {

/// Writes colmap or g2o of a map file. Throws std::runtime_error, naming the file and the fix.
void WriteMapExport(const RunExport& arguments);

}  // namespace msc_vo
