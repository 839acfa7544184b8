// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/benchmark_sequences.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "apps/cli/commands.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/recording_file.h"
#include "msc_vo/phone_recordings/folder_sequence.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Whether the argument is a file that is no recording, video or archive.
bool IsList(const std::string& path) {
  const std::string extension = Lowercase(fs::path(path).extension().string());
  const bool is_recording = extension == ".oni" || IsBag(path) || IsSequenceFile(path);
  return !is_recording && FileProblem(path).empty();
}

std::vector<std::string> ReadList(const std::string& path) {
  std::vector<std::string> sequences;
  std::istringstream content(ReadText(path));
  for (std::string line; std::getline(content, line);) {
    line = Trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    sequences.push_back((fs::path(path).parent_path() / line).string());
  }
  if (sequences.empty()) {
    throw std::runtime_error(path +
                             ": names no sequence; give one folder, bag or recording per "
                             "line");
  }
  return sequences;
}

// "room", or "room-2" if there is a room already.
std::string UniqueName(const std::string& name, const std::vector<BenchmarkSequence>& others) {
  std::string unique = name;
  const auto is_taken = [&] {
    return std::any_of(others.begin(), others.end(),
                       [&](const BenchmarkSequence& other) { return other.name == unique; });
  };
  for (int i = 2; is_taken(); ++i) unique = name + "-" + std::to_string(i);
  return unique;
}

void CheckNames(const PublishedSequence& sequence, const std::string& path) {
  const std::vector<std::string> formats = FolderFormatNames();
  const std::vector<CameraPreset>& cameras = CameraPresets();
  if (sequence.format != "auto" &&
      std::find(formats.begin(), formats.end(), sequence.format) == formats.end()) {
    throw std::runtime_error(path + ": " + sequence.name + ": '" + sequence.format +
                             "' is no layout (msc_vo replay --help lists them at --format)");
  }
  if (!sequence.camera.empty() &&
      std::none_of(cameras.begin(), cameras.end(),
                   [&](const CameraPreset& preset) { return preset.name == sequence.camera; })) {
    throw std::runtime_error(path + ": " + sequence.name + ": '" + sequence.camera +
                             "' is no camera (msc_vo replay --help lists them at --camera)");
  }
}

// The root and the folders in it, in the order of their names.
std::vector<std::string> Places(const std::string& root) {
  const std::string problem = FolderProblem(root);
  if (!problem.empty()) throw std::runtime_error(root + ": " + problem);
  std::vector<std::string> folders;
  for (const std::string& entry : ListFolder(root)) {
    if (IsFolder(entry)) folders.push_back(entry);
  }
  std::sort(folders.begin(), folders.end());
  folders.insert(folders.begin(), root);
  return folders;
}

}  // namespace

std::vector<BenchmarkSequence> ListBenchmarkSequences(const std::vector<std::string>& arguments) {
  std::vector<BenchmarkSequence> sequences;
  for (const std::string& argument : arguments) {
    for (const std::string& directory :
         IsList(argument) ? ReadList(argument) : std::vector<std::string>{argument}) {
      sequences.push_back({directory, UniqueName(SequenceName(directory), sequences),
                           static_cast<int>(sequences.size()), "", ""});
    }
  }
  return sequences;
}

Shard ParseShardArgument(const std::string& text) {
  const size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = ParseNumber(text.substr(0, slash));
    const auto count = ParseNumber(text.substr(slash + 1));
    const int k = number ? WholeNumber(*number).value_or(0) : 0;
    const int n = count ? WholeNumber(*count).value_or(0) : 0;
    if (k >= 1 && k <= n) return {k, n};
  }
  throw UsageError("--shard " + text + ": expected K/N with 1 <= K <= N, for instance 2/4");
}

std::vector<BenchmarkSequence> ShareOf(const std::vector<BenchmarkSequence>& sequences,
                                       const Shard& shard) {
  std::vector<BenchmarkSequence> share;
  for (const BenchmarkSequence& sequence : sequences) {
    if (sequence.index % shard.count == shard.number - 1) share.push_back(sequence);
  }
  return share;
}

bool IsPublishedTable(const std::vector<std::string>& arguments) {
  return std::any_of(arguments.begin(), arguments.end(), [](const std::string& argument) {
    const std::string ending = Lowercase(fs::path(argument).extension().string());
    return ending == ".yaml" || ending == ".yml";
  });
}

std::vector<BenchmarkSequence> FindPublishedSequences(const PublishedTable& table,
                                                      const std::string& path,
                                                      const std::string& root) {
  const std::vector<std::string> places = Places(root);
  std::vector<BenchmarkSequence> found;
  std::set<std::string> pages;
  for (size_t i = 0; i < table.sequences.size(); ++i) {
    const PublishedSequence& sequence = table.sequences[i];
    CheckNames(sequence, path);
    pages.insert(sequence.dataset + ": " + sequence.url);
    std::string directory;
    for (const std::string& folder : sequence.folders) {
      for (const std::string& place : places) {
        const std::string candidate = PathIn(place, folder);
        if (directory.empty() && IsFolder(candidate)) directory = candidate;
      }
    }
    if (directory.empty()) continue;
    found.push_back(
        {directory, sequence.name, static_cast<int>(i), sequence.format, sequence.camera});
  }
  if (!found.empty()) return found;
  std::string message = root + ": has none of the " + std::to_string(table.sequences.size()) +
                        " sequences of " + path + "; they can be had from";
  for (const std::string& page : pages) message += "\n  " + page;
  throw std::runtime_error(message);
}

void WritePublishedTables(const PublishedTable& table, const Benchmark& benchmark,
                          const std::string& root, const std::string& folder) {
  MakeFolder(folder);
  WriteFile(PathIn(folder, "published.md"), FormatPublishedMarkdown(table, benchmark, root));
  WriteFile(PathIn(folder, "published.html"), FormatPublishedHtml(table, benchmark, root));
  WriteFile(PathIn(folder, "published.json"), FormatPublishedJson(table, benchmark, root));
}

}  // namespace msc_vo
