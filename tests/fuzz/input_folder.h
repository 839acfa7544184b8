// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/fuzz_target.h"
#include <fcntl.h>
#include <unistd.h>

namespace msc_vo {

/// A folder in memory (/dev/shm, if there is one) that holds the files of the current input.
/// Deleted when the program ends.
class InputFolder {
 public:
  InputFolder() {
    const std::filesystem::path memory = "/dev/shm";
    const bool has_memory = access(memory.c_str(), W_OK) == 0;
    path_ = ((has_memory ? memory : std::filesystem::temp_directory_path()) / "msc_vo_fuzz_XXXXXX")
                .string();
    Require(mkdtemp(path_.data()) != nullptr, "a temporary folder can be made");
  }
  ~InputFolder() {
    for (const auto& [name, file] : files_) close(file);
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string Path(const std::string& name) const { return path_ + "/" + name; }

  /// Replaces the contents of a file and returns its path. The file stays open, which halves the
  /// time of an execution.
  std::string Write(const std::string& name, std::string_view content) {
    auto file = files_.find(name);
    if (file == files_.end()) {
      const int opened = open(Path(name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
      file = files_.emplace(name, opened).first;
    }
    const bool written = file->second >= 0 && ftruncate(file->second, 0) == 0 &&
                         pwrite(file->second, content.data(), content.size(), 0) ==
                             static_cast<ssize_t>(content.size());
    Require(written, "a file can be written in " + path_);
    return Path(name);
  }

  void Remove(const std::string& name) {
    const auto file = files_.find(name);
    if (file == files_.end()) return;
    close(file->second);
    unlink(Path(name).c_str());
    files_.erase(file);
  }

 private:
  std::string path_;
  std::map<std::string, int> files_;  // descriptors
};

inline std::string_view AsText(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Splits an input that stands for several files at lines with four dashes.
inline std::vector<std::string_view> SplitFiles(std::string_view input) {
  constexpr std::string_view kSeparator = "----\n";
  std::vector<std::string_view> files;
  for (size_t end = input.find(kSeparator); end != std::string_view::npos;
       end = input.find(kSeparator)) {
    files.push_back(input.substr(0, end));
    input.remove_prefix(end + kSeparator.size());
  }
  files.push_back(input);
  return files;
}

}  // namespace msc_vo
