// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/recording_file.h"
#include "msc_vo/datasets/sequence_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Ordered from the most specific layout to the most general one: the first layout that recognises a
// folder reads it.
constexpr const SequenceFormat* kSequenceFormats[] = {&kSevenScenesFormat, &kReplicaFormat,
                                                      &kScanNetFormat,     &kIclNuimFormat,
                                                      &kTumFormat,         &kRgbDepthFormat};

using Formats = std::vector<const SequenceFormat*>;

Formats AllFormats(const std::vector<SequenceFormat>& further) {
  Formats formats;
  for (const SequenceFormat& format : further) formats.push_back(&format);
  formats.insert(formats.end(), std::begin(kSequenceFormats), std::end(kSequenceFormats));
  return formats;
}

const SequenceFormat* Recognise(const Formats& formats, const std::string& directory) {
  for (const SequenceFormat* format : formats) {
    if (format->recognises(directory)) return format;
  }
  return nullptr;
}

// Says which folders within `directory` hold colour and depth images; empty unless one holds each.
std::string DescribeImageFolders(const std::string& directory) {
  constexpr size_t kMaxFolders = 100;
  std::string color, depth;
  std::vector<std::string> folders = {directory};
  for (size_t i = 0; i < folders.size() && i < kMaxFolders; ++i) {
    const std::string folder = folders[i];
    const FolderImages images = FindFolderImages(folder);
    if (images == FolderImages::kColor && color.empty()) color = folder;
    if (images == FolderImages::kDepth && depth.empty()) depth = folder;
    if (images != FolderImages::kNone || !FolderProblem(folder).empty()) continue;
    std::vector<std::string> entries = ListFolder(folder);
    std::sort(entries.begin(), entries.end());
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(folders), IsFolder);
  }
  if (color.empty() || depth.empty()) return "";
  return "\n" + color + " holds colour images, " + depth +
         " depth images; move them to rgb/ and depth/ in one folder";
}

[[noreturn]] void FailUnrecognised(const Formats& formats, const std::string& directory) {
  std::string message = directory + ": no RGB-D sequence found here. Known layouts:";
  for (const SequenceFormat* format : formats) {
    message += std::string("\n  ") + format->name + ": " + format->description;
  }
  // Giving the parent folder of a sequence is the most frequent mistake.
  std::vector<std::string> entries = ListFolder(directory);
  std::sort(entries.begin(), entries.end());
  const auto child = std::find_if(entries.begin(), entries.end(), [&](const std::string& entry) {
    return FolderProblem(entry).empty() && Recognise(formats, entry);
  });
  const auto file = std::find_if(entries.begin(), entries.end(), IsSequenceFile);
  if (child != entries.end()) {
    message += "\nDid you mean " + *child + "?";
  } else if (file != entries.end()) {
    message += "\n" + *file + " " + DescribeFile(*file);
  } else {
    message += DescribeImageFolders(directory);
  }
  throw std::runtime_error(message);
}

const SequenceFormat& FormatByName(const Formats& formats, const std::string& name) {
  std::string names;
  for (const SequenceFormat* format : formats) {
    if (name == format->name) return *format;
    names += std::string(", ") + format->name;
  }
  throw std::invalid_argument("unknown sequence format '" + name + "'; known: auto" + names);
}

std::string WithoutTrailingSlash(const std::string& directory) {
  std::filesystem::path path = std::filesystem::path(directory).lexically_normal();
  if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
  return path.string();
}

}  // namespace

std::vector<std::string> SequenceFormatNames() {
  std::vector<std::string> names;
  for (const SequenceFormat* format : kSequenceFormats) names.push_back(format->name);
  return names;
}

SequenceIndex OpenSequence(const std::string& directory, const std::string& format) {
  return OpenSequence(directory, format, {});
}

SequenceIndex OpenSequence(const std::string& directory, const std::string& format_name,
                           const std::vector<SequenceFormat>& further) {
  const Formats formats = AllFormats(further);
  const std::string folder = WithoutTrailingSlash(directory);
  const SequenceFormat* format =
      format_name == "auto" ? nullptr : &FormatByName(formats, format_name);
  const std::string problem = FolderProblem(folder);
  if (!problem.empty()) {
    const std::string file = DescribeFile(folder);
    throw std::runtime_error(directory + (file.empty()
                                              ? ": " + problem + "; give the folder of the sequence"
                                              : " " + file));
  }
  if (!format) format = Recognise(formats, folder);
  if (!format) FailUnrecognised(formats, folder);
  SequenceIndex index = format->read(folder);
  index.format = format->name;
  index.recorder = format->recorder;
  index.directory = folder;
  OrderEntries(&index);
  RequireMostImages(index, folder + " (read as " + format->name + ": " + format->description + ")");
  return index;
}

void OrderEntries(SequenceIndex* index) {
  const auto earlier = [](const SequenceEntry& a, const SequenceEntry& b) {
    return a.timestamp < b.timestamp;
  };
  std::vector<SequenceEntry>& entries = index->entries;
  if (!std::is_sorted(entries.begin(), entries.end(), earlier)) {
    index->warnings.push_back("the images are not listed in order of time; they were sorted");
    std::stable_sort(entries.begin(), entries.end(), earlier);
  }
  const size_t before = entries.size();
  entries.erase(std::unique(entries.begin(), entries.end(),
                            [](const SequenceEntry& a, const SequenceEntry& b) {
                              return a.timestamp == b.timestamp;
                            }),
                entries.end());
  if (entries.size() < before) {
    index->warnings.push_back(std::to_string(before - entries.size()) +
                              " images have the time stamp of another one and are left out");
  }
}

void RequireMostImages(const SequenceIndex& index, const std::string& source) {
  const size_t num_used = index.entries.size();
  if (num_used > 0 && 2 * num_used >= index.num_listed) return;
  std::string message = source + ": ";
  if (num_used == 0) {
    message += "no pair of colour and depth image found";
  } else {
    message += FormatText("only %zu of %zu images can be used", num_used, index.num_listed);
  }
  for (const std::string& warning : index.warnings) message += "\n" + warning;
  throw std::runtime_error(message);
}

std::string TruthName(const SequenceIndex& index) {
  return index.reference.empty() ? "ground truth" : "reference (" + index.reference + ")";
}

const char* TruthFileName(const SequenceIndex& index) {
  return index.reference.empty() ? "groundtruth.txt" : "reference.txt";
}

std::vector<std::string> InputFolders(const SequenceIndex& index) {
  std::set<std::string> folders = {index.directory};
  if (index.container) return {folders.begin(), folders.end()};
  for (const SequenceEntry& entry : index.entries) {
    for (const std::string& path : {entry.color_path, entry.depth_path}) {
      folders.insert(std::filesystem::path(path).parent_path().string());
    }
  }
  return {folders.begin(), folders.end()};
}

void RefuseToOverwriteSequence(const SequenceIndex& index, const std::string& file) {
  namespace fs = std::filesystem;
  std::error_code error;  // set if one of them does not exist
  const fs::path folder = fs::absolute(file).parent_path();
  const auto is_folder = [&](const std::string& path) {
    return fs::equivalent(folder, path, error);
  };
  std::vector<std::string> inputs;
  if (index.container) {
    inputs = {index.directory};
    if (IsFolder(index.directory)) inputs = ListFolder(index.directory);
    return RefuseToOverwrite(inputs, file);
  }
  if (index.calibration) inputs.push_back(index.calibration->origin);
  for (const SequenceEntry& entry : index.entries) {
    inputs.insert(inputs.end(), {entry.color_path, entry.depth_path});
  }
  const std::string ending = fs::path(file).extension().string();
  if (is_folder(index.directory)) {
    if (ending == ".txt" || ending == ".freiburg") inputs.push_back(file);
    return RefuseToOverwrite(inputs, file);
  }
  RefuseToOverwrite(inputs, file);
  for (const std::string& input : InputFolders(index)) {
    if (!is_folder(input)) continue;
    throw std::runtime_error(file + ": lies in a folder of images, " + input +
                             "; give another path for the results");
  }
}

}  // namespace msc_vo
