// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

/// The contents of benchmark.json: the numbers of benchmark.md, and for every run the measurements
/// of its summary.json.
std::string FormatBenchmarkJson(const Benchmark& benchmark);

}  // namespace msc_vo
