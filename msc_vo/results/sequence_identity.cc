// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/sequence_identity.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "msc_vo/checkpoint/checksum.h"
#include "msc_vo/results/internal/json_value.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

// Name and size of a file; its folder may have been moved.
std::string NameAndSize(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return fs::path(path).filename().string() + (error ? "?" : " " + std::to_string(size)) + "\n";
}

// Contents of a file in JSON; none if it is missing or damaged.
std::optional<Json> ReadJson(const std::string& path) {
  if (!FileProblem(path).empty()) return std::nullopt;
  Json json = Json::parse(ReadFile(path), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  return json;
}

std::string Text(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::optional<SequenceIdentity> ReadIdentity(const std::string& directory) {
  if (const auto json = ReadJson(PathIn(directory, "sequence.json"))) {
    return SequenceIdentity{Text(*json, "path"), Text(*json, "stamps"), Text(*json, "images")};
  }
  // Results of earlier versions.
  const auto summary = ReadJson(PathIn(directory, "summary.json"));
  if (!summary || !summary->contains("sequence") || !(*summary)["sequence"].is_object()) return {};
  return IdentifySequence(Text((*summary)["sequence"], "directory"));
}

bool SequenceIdentity::IsSame(const SequenceIdentity& other) const {
  if (path == other.path) return true;
  return !stamps.empty() && stamps == other.stamps && images == other.images;
}

SequenceIdentity IdentifySequence(const std::string& directory) {
  SequenceIdentity sequence;
  std::error_code error;
  const fs::path path = fs::canonical(directory, error);
  sequence.path = error ? directory : path.string();
  return sequence;
}

SequenceIdentity IdentifySequence(const SequenceIndex& index) {
  SequenceIdentity sequence = IdentifySequence(index.directory);
  if (index.camera) return sequence;
  std::string stamps, files;
  const bool is_files = !index.container || IsFolder(index.directory);
  for (const SequenceEntry& entry : index.entries) {
    stamps += FormatNumber(entry.timestamp) + " " + FormatNumber(entry.depth_delay) + "\n";
    if (is_files) files += NameAndSize(entry.color_path) + NameAndSize(entry.depth_path);
  }
  if (!is_files) {
    files = NameAndSize(index.directory);
  } else if (index.container) {  // files of text, a video, the files of a bag
    std::vector<std::string> others = ListFolder(index.directory);
    std::sort(others.begin(), others.end());
    for (const std::string& path : others) {
      if (!IsFolder(path)) files += NameAndSize(path);
    }
  }
  sequence.stamps = ChecksumText(stamps);
  sequence.images = ChecksumText(files);
  return sequence;
}

void WriteIdentity(const std::string& directory, const SequenceIdentity& sequence) {
  const Json json = {
      {"path", sequence.path}, {"stamps", sequence.stamps}, {"images", sequence.images}};
  WriteFile(PathIn(directory, "sequence.json"), FormatJson(json));
}

void RefuseToOverwriteOthers(const std::string& directory, const SequenceIdentity& sequence,
                             const std::vector<std::string>& names) {
  constexpr char kFix[] = "; give another folder with --output, or use --overwrite";
  const std::optional<SequenceIdentity> earlier = ReadIdentity(directory);
  if (earlier && !earlier->IsSame(sequence)) {
    throw std::runtime_error(directory + ": holds the results of another sequence, " +
                             earlier->path + kFix);
  }
  for (const char* description : {"sequence.json", "summary.json"}) {
    if (HasEntry(PathIn(directory, description))) return;
  }
  for (const std::string& name : names) {
    const std::string path = PathIn(directory, name);
    std::error_code error;
    if (!fs::is_regular_file(path, error)) continue;  // writing it fails, and names the reason
    throw std::runtime_error(path + ": exists, and is not the result of a run: " + directory +
                             " has neither sequence.json nor summary.json" + kFix);
  }
}

}  // namespace msc_vo
