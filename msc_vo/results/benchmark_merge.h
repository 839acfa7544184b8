// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/results/benchmark.h"

namespace msc_vo {

/// A share of the sequences of a benchmark: every `count`-th one, beginning with `number` (from 1).
struct Shard {
  int number = 1;
  int count = 1;
};

/// The name of a result file of a share: "benchmark-2-of-4.json" with the stem "benchmark" and the
/// ending ".json"; "benchmark.json" if there is only one share.
std::string ShardFileName(const std::string& stem, const Shard& shard, const std::string& ending);

/// Returns the paths of benchmark.json and benchmark-K-of-N.json in a folder, in the order of their
/// names. Throws std::runtime_error, naming the folder, if it cannot be listed.
std::vector<std::string> FindBenchmarkFiles(const std::string& folder);

/// Names the shares that the files of FindBenchmarkFiles() lack: "2 of 4"; empty if there are all.
std::vector<std::string> MissingShards(const std::vector<std::string>& files);

/// Says in what the settings of two benchmarks differ so that their runs cannot be compared; empty
/// if they can.
std::string DescribeDifference(const Benchmark& a, const Benchmark& b);

/// Adds the runs of `more` to `benchmark` and sorts all. Of two runs of the same sequence in the
/// same mode, one that failed is replaced by the other; otherwise the first is kept.
void AddRuns(const std::vector<BenchmarkRun>& more, Benchmark* benchmark);

/// Sorts the runs by sequence, then in the order of the modes.
void SortRuns(Benchmark* benchmark);

}  // namespace msc_vo
