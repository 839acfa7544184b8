// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/config/option_list.h"
#include "msc_vo/results/run_summary.h"

namespace msc_vo {

/// One sequence in one mode.
struct BenchmarkRun {
  std::string sequence;  ///< name, no two sequences share one
  std::string mode;
  /// Why there is no error to compare; empty: there is one. What ran until then is in the summary.
  std::string failure;
  RunSummary summary;
  RunCost cost;
  std::optional<TrajectoryError> error;  ///< usable, if there is no failure
};

/// Sequences times modes, with what is needed to do it again.
struct Benchmark {
  std::string command_line;
  std::string build;  ///< compiler and kind of build
  int num_processors = 0;
  std::vector<OptionText> changed_options;  ///< from the defaults; the mode is none of them
  std::vector<std::string> modes;
  std::vector<BenchmarkRun> runs;  ///< for each sequence the modes in their order
};

/// Geometric mean of the APE RMSE over the sequences on which every mode has one.
struct MeanError {
  int num_sequences = 0;
  std::vector<double> ape;  ///< metres, by mode; not a number without a sequence
};
MeanError GeometricMean(const Benchmark& benchmark);

/// The contents of benchmark.md: what was run, the APE of all modes side by side, a table per mode.
/// Also readable as it is on a terminal.
std::string FormatBenchmarkMarkdown(const Benchmark& benchmark);

/// The contents of benchmark.json: the same and all that summary.json says of each run.
std::string FormatBenchmarkJson(const Benchmark& benchmark);

}  // namespace msc_vo
