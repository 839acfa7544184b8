// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "apps/cli/benchmark_sequences.h"
#include "msc_vo/results/published_table.h"

namespace msc_vo {

/// Whether the arguments of benchmark are a table of the literature (.yaml, .yml).
bool IsPublishedTable(const std::vector<std::string>& arguments);

/// The sequences of a table that are in the folder `root`, or in one of its folders. Throws
/// std::runtime_error, naming the folder and the pages of the datasets, if there are none, and for
/// an unknown layout or camera.
std::vector<BenchmarkSequence> FindPublishedSequences(const PublishedTable& table,
                                                      const std::string& path,
                                                      const std::string& root);

/// Writes published.md, published.html and published.json to a folder.
void WritePublishedTables(const PublishedTable& table, const Benchmark& benchmark,
                          const std::string& root, const std::string& folder);

}  // namespace msc_vo
