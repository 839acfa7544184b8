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
  std::string sequence;    ///< unique name
  int sequence_index = 0;  ///< position of the sequence in the list of all, from 0
  std::string directory;   ///< of the sequence
  std::string mode;
  /// Reason why the run has no errors; empty if it succeeded. A failed run may have a summary of
  /// the frames before the failure.
  std::string failure;
  RunSummary summary;
  RunCost cost;
  std::optional<TrajectoryError> error;  ///< usable unless the run failed
  /// JSON object with the measurements, if they were read from a file. The members above then hold
  /// only what the tables show.
  std::string recorded;
  std::string folder;  ///< of the files of the run; empty: unknown
};

/// Runs of several sequences in several modes, with the settings needed to reproduce them.
struct Benchmark {
  std::string command_line;
  std::string build;  ///< compiler and build type
  int num_processors = 0;
  int max_frames = 0;                       ///< of every sequence; 0: all
  std::string mask;                         ///< in each sequence, or absolute; empty: none
  bool mask_zero = false;                   ///< pixels of masks that are zero are left out
  std::vector<OptionText> changed_options;  ///< differences from the defaults, without the mode
  std::vector<std::string> modes;
  std::vector<BenchmarkRun> runs;  ///< by sequence, then in the order of `modes`
};

/// Names of the sequences in the order of their first runs.
std::vector<std::string> SequenceNames(const Benchmark& benchmark);

/// Null if the sequence was not run in this mode.
const BenchmarkRun* FindRun(const Benchmark& benchmark, const std::string& sequence,
                            const std::string& mode);

/// Geometric mean of the APE RMSE over the sequences on which no mode failed.
struct MeanError {
  int num_sequences = 0;
  std::vector<double> ape;  ///< metres, by mode; NaN without such a sequence
};
MeanError GeometricMean(const Benchmark& benchmark);

/// The contents of benchmark.md: settings, a table of the APE of all modes, a table per mode.
/// Columns are aligned, so that the text is readable on a terminal.
std::string FormatBenchmarkMarkdown(const Benchmark& benchmark);

}  // namespace msc_vo
