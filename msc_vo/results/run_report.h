// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// Summary of a finished run as a table for the terminal. `output_directory`: folder of the result
/// files.
std::string FormatRunTable(const RunSummary& summary, const RunContext& context,
                           const std::string& output_directory);

/// The contents of report.html.
std::string FormatReport(const OdometryResult& result, const RunSummary& summary,
                         const RunContext& context);

}  // namespace msc_vo
