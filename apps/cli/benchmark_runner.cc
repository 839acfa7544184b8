// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/benchmark_runner.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

#include "apps/cli/command_log.h"
#include "apps/cli/run_files.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/results/benchmark_index.h"
#include "msc_vo/results/benchmark_json.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

constexpr char kUnfinished[] = "the program was ended during this run";

// The mask of a sequence: relative paths are those in its folder.
std::string MaskOf(const BenchmarkSequence& sequence, const std::string& mask) {
  if (mask.empty()) return "";
  const std::string path = PathIn(sequence.directory, mask);
  if (HasEntry(path)) return path;
  throw std::runtime_error(
      path +
      ": does not exist; --mask of benchmark is a file or folder in the folder "
      "of each sequence, or the absolute path of one for all of them");
}

// Throws std::runtime_error if the sequence has no ground truth.
RgbdDecoder OpenWithGroundTruth(const SequenceArguments& sequence,
                                const Configuration& configuration) {
  RgbdDecoder decoder = OpenDecoder(sequence, configuration);
  PrintWarnings(decoder.Warnings());
  CheckInput(decoder);
  if (!decoder.index().ground_truth.empty()) return decoder;
  throw std::runtime_error(decoder.index().directory +
                           ": no ground truth (groundtruth.txt or the file of the layout); add it, "
                           "or use msc_vo replay");
}

}  // namespace

void RefuseToReplaceTables(const std::string& folder, const Shard& shard) {
  if (HasEntry(PathIn(folder, ShardFileName("benchmark", shard, ".json")))) return;
  for (const auto& [stem, ending] : {std::pair("benchmark", ".md"), std::pair("index", ".html")}) {
    const std::string path = PathIn(folder, ShardFileName(stem, shard, ending));
    if (!HasEntry(path)) continue;
    throw std::runtime_error(path + ": exists, and is not the result of a benchmark: " + folder +
                             " has no " + ShardFileName("benchmark", shard, ".json") +
                             "; give another folder with --output, or use --overwrite");
  }
}

void WriteBenchmarkTables(const std::string& folder, const Shard& shard,
                          const Benchmark& benchmark) {
  MakeFolder(folder);
  const auto path = [&](const char* stem, const char* ending) {
    return PathIn(folder, ShardFileName(stem, shard, ending));
  };
  WriteFile(path("benchmark", ".json"), FormatBenchmarkJson(benchmark));
  WriteFile(path("benchmark", ".md"), FormatBenchmarkMarkdown(benchmark));
  WriteFile(path("index", ".html"), FormatBenchmarkIndex(benchmark, folder));
}

BenchmarkRunner::BenchmarkRunner(const BenchmarkPlan& plan, const InterruptGuard& interrupt,
                                 Benchmark* benchmark)
    : plan_(plan), interrupt_(interrupt), benchmark_(benchmark) {}

void BenchmarkRunner::Resume() {
  if (!HasEntry(plan_.output)) return;
  const auto is_planned = [this](const BenchmarkRun& run) {
    return std::any_of(
        plan_.sequences.begin(), plan_.sequences.end(), [&run](const BenchmarkSequence& sequence) {
          return sequence.name == run.sequence && sequence.directory == run.directory;
        });
  };
  for (const std::string& path : FindBenchmarkFiles(plan_.output)) {
    const Benchmark earlier = ReadBenchmarkJson(path);
    const std::string difference = DescribeDifference(earlier, *benchmark_);
    if (!difference.empty()) {
      throw std::runtime_error(path + ": cannot be resumed, because its settings differ: " +
                               difference + "; use the same settings, or another --output");
    }
    std::vector<BenchmarkRun> finished;
    for (const BenchmarkRun& run : earlier.runs) {
      if (!is_planned(run)) continue;
      if (run.failure.empty()) {
        finished.push_back(run);
      } else {
        attempted_.push_back(run.sequence);
      }
    }
    AddRuns(finished, benchmark_);
  }
  // The list may have changed its order.
  for (BenchmarkRun& run : benchmark_->runs) {
    for (const BenchmarkSequence& sequence : plan_.sequences) {
      if (sequence.name == run.sequence) run.sequence_index = sequence.index;
    }
  }
  SortRuns(benchmark_);
}

bool BenchmarkRunner::IsDone(const std::string& sequence, const std::string& mode) const {
  return std::any_of(benchmark_->runs.begin(), benchmark_->runs.end(),
                     [&](const BenchmarkRun& run) {
                       return run.sequence == sequence && run.mode == mode && run.failure.empty();
                     });
}

// The folders of the runs, and the table, whose rows would be lost.
void BenchmarkRunner::RefuseToOverwriteOtherRuns() const {
  std::vector<SequenceIdentity> planned;
  for (const BenchmarkSequence& sequence : plan_.sequences) {
    planned.push_back(IdentifySequence(sequence.directory));
    for (const std::string& mode : benchmark_->modes) {
      RefuseSequenceFolder(RunFolder(sequence.name, mode));
      RefuseToOverwriteOthers(RunFolder(sequence.name, mode), planned.back(), ResultFileNames());
    }
  }
  RefuseToReplaceTables(plan_.output, plan_.shard);
  const fs::path table = fs::path(plan_.output) / ShardFileName("benchmark", plan_.shard, ".json");
  if (!HasEntry(table.string())) return;
  for (const BenchmarkRun& run : ReadBenchmarkJson(table.string()).runs) {
    const SequenceIdentity earlier = IdentifySequence(run.directory);
    const auto is_same = [&](const SequenceIdentity& s) { return s.IsSame(earlier); };
    if (std::any_of(planned.begin(), planned.end(), is_same)) continue;
    throw std::runtime_error(table.string() + ": holds the results of another sequence, " +
                             run.directory +
                             "; give another folder with --output, or use --overwrite");
  }
}

std::string BenchmarkRunner::RunFolder(const std::string& sequence, const std::string& mode) const {
  return (fs::path(plan_.output) / sequence / mode).string();
}

std::string BenchmarkRunner::Run() {
  if (!plan_.overwrite) RefuseToOverwriteOtherRuns();
  WriteBenchmarkTables(plan_.output, plan_.shard,
                       *benchmark_);  // fails early if it is not writable
  std::vector<BenchmarkSequence> sequences = plan_.sequences;
  // A sequence that ends the program must not keep others from being run.
  std::stable_partition(sequences.begin(), sequences.end(), [this](const BenchmarkSequence& s) {
    return std::find(attempted_.begin(), attempted_.end(), s.name) == attempted_.end();
  });
  for (const BenchmarkSequence& sequence : sequences) {
    if (interrupt_.IsInterrupted()) break;
    RunSequenceModes(sequence);
  }
  return problem_;
}

void BenchmarkRunner::RunSequenceModes(const BenchmarkSequence& sequence) {
  const std::vector<std::string>& modes = benchmark_->modes;
  const auto is_done = [&](const std::string& mode) { return IsDone(sequence.name, mode); };
  if (std::all_of(modes.begin(), modes.end(), is_done)) return;
  BenchmarkRun row;
  row.sequence = sequence.name;
  row.sequence_index = sequence.index;
  row.directory = sequence.directory;
  std::optional<RgbdDecoder> decoder;
  try {
    SequenceArguments arguments = plan_.layout;
    arguments.directory = sequence.directory;
    arguments.mask = MaskOf(sequence, plan_.layout.mask);
    if (!sequence.format.empty()) arguments.format = sequence.format;
    if (!sequence.camera.empty()) arguments.camera = sequence.camera;
    decoder.emplace(
        OpenWithGroundTruth(arguments, plan_.configurations.front()));  // modes share the camera
  } catch (const std::exception& error) {
    row.failure = error.what();
    PrintError(sequence.name + " failed: " + row.failure);
  }
  for (size_t i = 0; i < modes.size() && !interrupt_.IsInterrupted(); ++i) {
    if (is_done(modes[i])) continue;
    row.mode = modes[i];
    BenchmarkRun finished = row;
    if (decoder) RunMode(*decoder, plan_.configurations[i], &finished);
    Record(std::move(finished));
  }
}

// Runs one sequence in one mode and writes its files. `row` gets the measurements, also if the run
// fails.
void BenchmarkRunner::RunMode(const RgbdDecoder& decoder, const Configuration& configuration,
                              BenchmarkRun* row) {
  BenchmarkRun unfinished = *row;
  unfinished.failure = kUnfinished;
  Record(std::move(unfinished));
  if (!plan_.run.quiet) std::cerr << row->sequence << ", " << row->mode << ":" << std::endl;
  try {
    row->folder = RunFolder(row->sequence, row->mode);
    RefuseToOverwriteInputs(decoder.index(), plan_.input_files, row->folder);
    RefuseSequenceFolder(row->folder);
    RunFiles files(row->folder, IdentifySequence(decoder.index()));
    Configuration own = configuration;
    UseDepthSensorOf(decoder.index(), &own.odometry);
    const SequenceRun run =
        RunSequence(decoder, own, plan_.run, interrupt_,
                    {[&](const FrameResult& frame) { files.Add(frame); }, {}, {}});
    row->summary = run.summary;
    row->cost = run.context.cost;
    row->error = run.context.error;
    if (run.HasImages()) {
      const std::string missing = files.Finish(run.result, run.context);
      if (!missing.empty()) PrintWarning(missing);
    }
    if (run.exit_code != kExitSuccess) throw std::runtime_error(run.context.outcome);
    if (!row->error->usable) throw std::runtime_error("no errors: " + row->error->message);
  } catch (const std::exception& error) {
    row->failure = error.what();
    PrintError(row->sequence + ", " + row->mode + " failed: " + row->failure);
  }
}

// Adds or replaces a run and writes the tables. If they cannot be written now, the next run may
// write them.
void BenchmarkRunner::Record(BenchmarkRun row) {
  std::vector<BenchmarkRun>& runs = benchmark_->runs;
  EraseIf(&runs, [&row](const BenchmarkRun& run) {
    return run.sequence == row.sequence && run.mode == row.mode;
  });
  runs.push_back(std::move(row));
  SortRuns(benchmark_);
  problem_.clear();
  try {
    WriteBenchmarkTables(plan_.output, plan_.shard, *benchmark_);
  } catch (const std::exception& error) {
    problem_ = error.what();
    if (!has_warned_) PrintWarning(problem_ + "; the benchmark goes on");
    has_warned_ = true;
  }
}

}  // namespace msc_vo
