// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

/// The contents of benchmark.json: the numbers of benchmark.md, and for every run the measurements
/// of its summary.json.
std::string FormatBenchmarkJson(const Benchmark& benchmark);

/// Reads a file with the contents of FormatBenchmarkJson(), which gives the same measurements
/// again. The folders of the runs are those beside the file. Throws std::runtime_error naming the
/// file if it is no such file, or of another version of msc_vo.
Benchmark ReadBenchmarkJson(const std::string& path);

}  // namespace msc_vo
