// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// The contents of summary.json.
std::string FormatSummaryJson(const RunSummary& summary, const RunContext& context);

}  // namespace msc_vo
