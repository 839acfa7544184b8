// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/results/benchmark_merge.h"
#include "msc_vo/results/published_table.h"

namespace msc_vo {

/// A sequence of a benchmark.
struct BenchmarkSequence {
  std::string directory;
  std::string name;         ///< of its results, unique
  int index = 0;            ///< in the whole list, from 0
  std::string format = "";  ///< layout; empty: that of the command
  std::string camera = "";  ///< preset; empty: that of the command
};

/// Expands list files, which name one sequence per line, relative to the folder of the list, and
/// names all sequences: those with the same name get a number.
std::vector<BenchmarkSequence> ListBenchmarkSequences(const std::vector<std::string>& arguments);

/// Parses "K/N" with 1 <= K <= N. Throws UsageError on another text.
Shard ParseShardArgument(const std::string& text);

/// The sequences of a share: every N-th, beginning with the K-th.
std::vector<BenchmarkSequence> ShareOf(const std::vector<BenchmarkSequence>& sequences,
                                       const Shard& shard);

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
