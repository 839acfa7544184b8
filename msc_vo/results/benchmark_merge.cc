// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/benchmark_merge.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <tuple>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// Number and count of a file of a share: "benchmark-2-of-4.json".
bool ParseShard(const std::string& path, Shard* shard) {
  static const std::regex pattern("benchmark-([0-9]{1,6})-of-([0-9]{1,6})\\.json");
  std::smatch match;
  const std::string name = std::filesystem::path(path).filename().string();
  if (!std::regex_match(name, match, pattern)) return false;
  *shard = {std::stoi(match[1]), std::stoi(match[2])};
  return true;
}

std::string OptionsText(const Benchmark& benchmark) {
  std::string text;
  for (const OptionText& option : benchmark.changed_options) {
    text += " " + option.path + "=" + option.value;
  }
  return text.empty() ? " none" : text;
}

std::string MaskText(const Benchmark& benchmark) {
  if (benchmark.mask.empty()) return "none";
  return benchmark.mask + (benchmark.mask_zero ? " --mask-zero" : "");
}

std::string ModesText(const Benchmark& benchmark) {
  std::string text;
  for (const std::string& mode : benchmark.modes) text += " " + mode;
  return text;
}

}  // namespace

std::string ShardFileName(const std::string& stem, const Shard& shard, const std::string& ending) {
  if (shard.count == 1) return stem + ending;
  return stem + "-" + std::to_string(shard.number) + "-of-" + std::to_string(shard.count) + ending;
}

std::vector<std::string> FindBenchmarkFiles(const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& path : ListFolder(folder)) {
    Shard shard;
    if (std::filesystem::path(path).filename() == "benchmark.json" || ParseShard(path, &shard)) {
      files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> MissingShards(const std::vector<std::string>& files) {
  std::set<std::pair<int, int>> present;  // count, number
  std::set<int> counts;
  for (const std::string& path : files) {
    Shard shard;
    if (!ParseShard(path, &shard)) continue;
    present.emplace(shard.count, shard.number);
    counts.insert(shard.count);
  }
  std::vector<std::string> missing;
  for (const int count : counts) {
    for (int number = 1; number <= count; ++number) {
      if (present.count({count, number}) > 0) continue;
      missing.push_back(std::to_string(number) + " of " + std::to_string(count));
    }
  }
  return missing;
}

std::string DescribeDifference(const Benchmark& a, const Benchmark& b) {
  if (ModesText(a) != ModesText(b)) return "modes" + ModesText(a) + " and" + ModesText(b);
  if (OptionsText(a) != OptionsText(b)) {
    return "options" + OptionsText(a) + " and" + OptionsText(b);
  }
  if (MaskText(a) != MaskText(b)) return "--mask " + MaskText(a) + " and " + MaskText(b);
  if (a.max_frames != b.max_frames) {
    return "--max-frames " + std::to_string(a.max_frames) + " and " + std::to_string(b.max_frames) +
           " (0: all)";
  }
  return "";
}

void AddRuns(const std::vector<BenchmarkRun>& more, Benchmark* benchmark) {
  for (const BenchmarkRun& run : more) {
    const auto same = std::find_if(
        benchmark->runs.begin(), benchmark->runs.end(), [&](const BenchmarkRun& other) {
          return other.sequence == run.sequence && other.mode == run.mode;
        });
    if (same == benchmark->runs.end()) {
      benchmark->runs.push_back(run);
    } else if (!same->failure.empty() && run.failure.empty()) {
      *same = run;
    }
  }
  SortRuns(benchmark);
}

void SortRuns(Benchmark* benchmark) {
  const auto place = [benchmark](const BenchmarkRun& run) {
    const auto mode = std::find(benchmark->modes.begin(), benchmark->modes.end(), run.mode);
    return std::make_tuple(run.sequence_index, run.sequence, mode - benchmark->modes.begin());
  };
  std::stable_sort(
      benchmark->runs.begin(), benchmark->runs.end(),
      [&](const BenchmarkRun& a, const BenchmarkRun& b) { return place(a) < place(b); });
}

}  // namespace msc_vo
