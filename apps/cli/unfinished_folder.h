// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// A folder for files that are written before they are moved to their places. Exists as long as
/// the object. If the process is killed, the next one with the same folder removes what is left.
class UnfinishedFolder {
 public:
  /// The file in the folder by which it is recognised, and which is locked by its process.
  static constexpr char kMark[] = "msc_vo.lock";

  /// Creates the folder in a folder that exists. Throws std::runtime_error, naming the file and the
  /// fix, if another process writes into it, if no UnfinishedFolder has created it, or if it cannot
  /// be created.
  explicit UnfinishedFolder(const std::string& path);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  const std::string& path() const { return path_; }
  /// The path of a file in it.
  std::string File(const std::string& name) const;

 private:
  std::string path_;
  int lock_ = -1;  // file descriptor
};

}  // namespace msc_vo
