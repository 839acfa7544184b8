// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>

#include "msc_vo/results/internal/json_value.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// The measurements of a run that summary.json and benchmark.json have in common: frames, map,
/// Manhattan axes, noise, errors, times.
Json MeasurementsToJson(const RunSummary& summary, const std::optional<TrajectoryError>& error,
                        const RunCost& cost);

}  // namespace msc_vo
