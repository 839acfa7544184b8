// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/results/benchmark_merge.h"

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

}  // namespace msc_vo
