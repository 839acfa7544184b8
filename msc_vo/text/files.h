// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace msc_vo {

// Sizes that no file of its kind has: a wrong file is refused before it fills the memory.
constexpr std::uintmax_t kMaxTextBytes = std::uintmax_t{256} << 20;  // lists, trajectories, maps
constexpr std::uintmax_t kMaxOptionsBytes = std::uintmax_t{1} << 20;
constexpr std::uintmax_t kMaxImageBytes = std::uintmax_t{256} << 20;

// Whether a folder has an entry of that name, be it a file, a folder or a link that leads nowhere.
// What is wrong with an entry, reading it tells.
bool HasEntry(const std::string& path);

// Whether `path` is a folder or a link to one. Never throws.
bool IsFolder(const std::string& path);

// What keeps `path` from being read as a regular file of at most `max_bytes` ("does not exist", "is
// a pipe; ..."), or from being listed as a folder; empty: nothing.
std::string FileProblem(const std::string& path, std::uintmax_t max_bytes = kMaxTextBytes);
std::string FolderProblem(const std::string& path);

// The whole file, byte for byte. Only regular files are read: pipes and devices may have no end.
// Throws std::runtime_error, naming the file, if it cannot be read or is larger than `max_bytes`.
std::string ReadFile(const std::string& path, std::uintmax_t max_bytes = kMaxTextBytes);

// Full paths of what is in a folder. Throws std::runtime_error, naming it, if it cannot be listed.
std::vector<std::string> ListFolder(const std::string& folder);

// Writes `content` beside `path` and renames it into place, so that a reader never sees half a file
// and an interrupted run leaves the previous one. A symbolic link is replaced and its target left
// alone. Throws std::runtime_error, naming the file, if that fails or if `path` is a device, a pipe
// or a folder.
void WriteFile(const std::string& path, const std::string& content);

// A new file that grows while a program runs: what was appended is on disk even if the program is
// killed. Replaces an existing file as WriteFile does.
class GrowingFile {
 public:
  // Both throw std::runtime_error naming the file.
  explicit GrowingFile(const std::string& path);
  void Append(const std::string& text);

 private:
  std::string path_;
  std::ofstream stream_;
};

// Makes a folder and those above it, if they do not exist. Throws std::runtime_error naming it.
void MakeFolder(const std::string& path);

// Throws std::runtime_error if `output` is one of `inputs`, files or folders, perhaps under another
// name (a link, "a/../b"): writing it would destroy what was given to be read. What does not exist
// is nothing's other name.
void RefuseToOverwrite(const std::vector<std::string>& inputs, const std::string& output);

}  // namespace msc_vo
