// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/synthesized_folder.h"

#include <optional>
#include <regex>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;
using OptionValues = std::map<std::string, std::string>;

constexpr const char* kImageFolders[] = {"rgb", "depth"};
constexpr char kOverwriteAdvice[] = ", give another folder, or use --overwrite";

bool IsSynthesized(const fs::path& folder) {
  const std::string camera = (folder / "camera.txt").string();
  return FileProblem(camera).empty() &&
         ReadFile(camera).find(kSynthesizedMark) != std::string::npos;
}

// The options of the sequence in a folder. Empty if truth.json does not have them.
OptionValues ReadOptionValues(const fs::path& folder) {
  const std::string truth = (folder / "truth.json").string();
  if (!FileProblem(truth).empty()) return {};
  try {
    return nlohmann::json::parse(ReadFile(truth)).at(kSynthesizedOptions).get<OptionValues>();
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

// A flag that is not given is false.
std::string ValueOf(const OptionValues& options, const std::string& name) {
  const auto value = options.find(name);
  return value == options.end() ? "false" : value->second;
}

bool AreEqual(const std::string& a, const std::string& b) {
  const std::optional<double> x = ParseNumber(a), y = ParseNumber(b);
  return x && y ? *x == *y : a == b;
}

// The first option that differs; empty if there is none.
std::string DescribeDifference(const OptionValues& before, const OptionValues& now) {
  OptionValues all = before;
  all.insert(now.begin(), now.end());
  for (const auto& [name, value] : all) {
    const std::string old_value = ValueOf(before, name), new_value = ValueOf(now, name);
    if (!AreEqual(old_value, new_value))
      return "--" + name + " " + old_value + ", now " + new_value;
  }
  return "";
}

// Whether a file has the name of an image of the command: a time stamp in microseconds.
bool IsNamedByStamp(const fs::path& file) {
  static const std::regex name(R"(\d+\.\d{6}\.(png|jpg))");
  return std::regex_match(file.filename().string(), name);
}

// Throws std::runtime_error if a sequence of these options would replace anything but itself.
void RefuseToReplace(const fs::path& folder, const OptionValues& options) {
  const std::string name = folder.string();
  if (!HasEntry(name) || ListFolder(name).empty()) return;
  if (!IsSynthesized(folder)) {
    throw std::runtime_error(name +
                             " is not empty and was not written by msc_vo synthesize: empty it" +
                             kOverwriteAdvice);
  }
  const OptionValues before = ReadOptionValues(folder);
  const std::string difference = DescribeDifference(before, options);
  if (!difference.empty()) {
    throw std::runtime_error(
        name + ": holds a sequence of " +
        (before.empty() ? "unknown options" : "other options (" + difference + ")") +
        ": remove it" + kOverwriteAdvice);
  }
  for (const char* kind : kImageFolders) {
    if (!IsFolder((folder / kind).string())) continue;
    for (const std::string& file : ListFolder((folder / kind).string())) {
      if (IsNamedByStamp(file)) continue;
      throw std::runtime_error(file + ": was not written by msc_vo synthesize; move it" +
                               kOverwriteAdvice);
    }
  }
}

void RemoveImages(const fs::path& folder) {
  if (!IsFolder(folder.string())) return;
  for (const std::string& file : ListFolder(folder.string())) {
    if (IsNamedByStamp(file)) fs::remove(file);
  }
}

}  // namespace

void PrepareSequenceFolder(const fs::path& folder, const OptionValues& options, bool overwrite) {
  if (!overwrite) RefuseToReplace(folder, options);
  for (const char* kind : kImageFolders) {
    // The images behind a link are those of another folder.
    if (fs::is_symlink(folder / kind)) fs::remove(folder / kind);
  }
  if (IsSynthesized(folder)) {
    for (const char* kind : kImageFolders) RemoveImages(folder / kind);
  }
  for (const char* kind : kImageFolders) MakeFolder((folder / kind).string());
}

}  // namespace msc_vo
