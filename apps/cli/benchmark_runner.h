// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "apps/cli/benchmark_sequences.h"
#include "apps/cli/configuration_arguments.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/results/benchmark.h"
#include "msc_vo/results/benchmark_merge.h"

namespace msc_vo {

/// What a benchmark runs, and how.
struct BenchmarkPlan {
  std::vector<BenchmarkSequence> sequences;   ///< the share of this program
  std::vector<Configuration> configurations;  ///< one for each of Benchmark::modes
  SequenceArguments layout;                   ///< without the directory
  RunArguments run;
  std::vector<std::string> input_files;  ///< which must not be overwritten; names may be empty
  std::string output;
  bool overwrite = false;  ///< also results of other sequences
  Shard shard;
};

/// Throws std::runtime_error if the tables would replace files that are not those of a benchmark,
/// whose folder has a benchmark.json.
void RefuseToReplaceTables(const std::string& folder, const Shard& shard);

/// Writes the tables of a benchmark to a folder: benchmark.json, benchmark.md and index.html, with
/// the number of the share in their names. Throws std::runtime_error naming the first file that
/// cannot be written.
void WriteBenchmarkTables(const std::string& folder, const Shard& shard,
                          const Benchmark& benchmark);

/// Runs every mode on every sequence and writes the files of each run. The tables are written
/// before and after each run, so that a program that is killed loses the run that it is in.
class BenchmarkRunner {
 public:
  /// `benchmark` has the settings and no runs. All references must outlive the runner.
  BenchmarkRunner(const BenchmarkPlan& plan, const InterruptGuard& interrupt, Benchmark* benchmark);

  /// Takes finished runs of the same sequences from the tables in the output folder; failed and
  /// unfinished ones are repeated, after all others. Throws std::runtime_error, naming the file, if
  /// these tables have other settings.
  void Resume();

  /// Runs what is not yet done. Failures are printed and become part of the results. Returns why
  /// the tables could not be written in the end; empty if they are. Throws std::runtime_error
  /// before the first run if they cannot be written, or if a run would overwrite results of another
  /// sequence.
  [[nodiscard]] std::string Run();

 private:
  bool IsDone(const std::string& sequence, const std::string& mode) const;
  void RefuseToOverwriteOtherRuns() const;
  std::string RunFolder(const std::string& sequence, const std::string& mode) const;
  void RunSequenceModes(const BenchmarkSequence& sequence);
  void RunMode(const RgbdDecoder& decoder, const Configuration& configuration, BenchmarkRun* row);
  void Record(BenchmarkRun row);

  const BenchmarkPlan& plan_;
  const InterruptGuard& interrupt_;
  Benchmark* benchmark_;
  std::vector<std::string> attempted_;  // sequences with a run that failed or did not end
  std::string problem_;                 // why the tables could not be written last
  bool has_warned_ = false;
};

}  // namespace msc_vo
