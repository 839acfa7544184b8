// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

/// An HTML page with a table over all sequences and modes. Every error links to the report of its
/// run, relative to `folder`, in which the page will be.
std::string FormatBenchmarkIndex(const Benchmark& benchmark, const std::string& folder);

}  // namespace msc_vo
