// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace msc_vo {

/// Upper bounds of file sizes: a wrong file is refused before it fills the memory.
constexpr std::uintmax_t kMaxTextBytes = std::uintmax_t{256} << 20;  ///< lists, trajectories, maps
constexpr std::uintmax_t kMaxOptionsBytes = std::uintmax_t{1} << 20;
constexpr std::uintmax_t kMaxImageBytes = std::uintmax_t{256} << 20;

/// Tests whether a folder has an entry of this name: a file, a folder, or a symbolic link even if
/// it is broken. Whether the entry can be read is not tested.
bool HasEntry(const std::string& path);

/// Returns the path of an entry of a folder.
std::string PathIn(const std::string& folder, const std::string& name);

/// Returns the absolute path of the folder that holds a folder.
std::string ParentFolder(const std::string& folder);

/// Returns the path of the entry of a folder with this name, or else of one whose name differs in
/// the case of its letters only ("RGB" for "rgb"); empty if there is neither.
std::string FindEntry(const std::string& folder, const std::string& name);

/// Returns the path of the first of these entries that a folder has, see FindEntry(); empty if it
/// has none.
std::string FirstEntry(const std::string& folder, const std::vector<std::string>& names);

/// Tests whether `path` is a folder or a link to one. Never throws.
bool IsFolder(const std::string& path);

/// Describes an error of the system, in the "C" locale.
std::string ErrorText(const std::error_code& error);

/// Describes why `path` cannot be read as a regular file of at most `max_bytes`: "does not exist",
/// "is a pipe; ...". Empty if it can.
std::string FileProblem(const std::string& path, std::uintmax_t max_bytes = kMaxTextBytes);

/// Describes why `path` cannot be listed as a folder. Empty if it can.
std::string FolderProblem(const std::string& path);

/// Returns the contents of a file, byte for byte. Only regular files are read, because pipes and
/// devices may be endless.
/// Throws std::runtime_error, naming the file, if it cannot be read or is larger than `max_bytes`.
std::string ReadFile(const std::string& path, std::uintmax_t max_bytes = kMaxTextBytes);

/// Returns the first bytes of a file, up to `count`; fewer if it is shorter or cannot be read.
std::string ReadBeginning(const std::string& path, size_t count);

/// Returns the full paths of the entries of a folder, in no particular order.
/// Throws std::runtime_error, naming the folder, if it cannot be listed.
std::vector<std::string> ListFolder(const std::string& folder);

/// Writes `content` to a temporary file and renames it to `path`: readers never see a partial file,
/// and an interrupted run leaves the previous one. A symbolic link is replaced, its target is kept.
/// Throws std::runtime_error, naming the file, if that fails (WriteError) or if `path` is a device,
/// a pipe or a folder.
void WriteFile(const std::string& path, const std::string& content);

/// Throws std::runtime_error as WriteFile() would for a file that cannot be written, and writes
/// nothing: for the results of long work.
void CheckWritable(const std::string& path);

/// A file that is written in steps. Appended text is on disk even if the program is killed; text
/// that does not fit is not there at all. An existing file is replaced as by WriteFile().
class GrowingFile {
 public:
  /// The file begins with `text`. Both throw std::runtime_error naming the file, as WriteFile().
  explicit GrowingFile(const std::string& path, const std::string& text = "");
  void Append(const std::string& text);

 private:
  std::string path_;
  std::ofstream stream_;
};

/// Creates a folder and its parents if they do not exist. Throws std::runtime_error naming it.
void MakeFolder(const std::string& path);

/// Throws std::runtime_error if `output` is the same file or folder as one of `inputs`, possibly
/// under another name (a link, "a/../b"), because writing it would destroy an input.
void RefuseToOverwrite(const std::vector<std::string>& inputs, const std::string& output);

}  // namespace msc_vo
