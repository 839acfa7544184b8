// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace msc_vo {

/// A binary file that survives a crash of the system. The functions throw std::runtime_error naming
/// the file.
class GrowingBinary {
 public:
  /// Opens the file, or creates it.
  explicit GrowingBinary(const std::string& path);
  ~GrowingBinary();
  GrowingBinary(const GrowingBinary&) = delete;
  GrowingBinary& operator=(const GrowingBinary&) = delete;

  /// Ends the file behind `size` bytes.
  void Resize(uint64_t size);
  /// Writes bytes from position `offset` on. What is before it does not change.
  void Write(uint64_t offset, std::string_view bytes);
  /// Waits until all is on the disk, not only with the operating system.
  void Sync();
  /// Gives the file another name, in place of the file that had it.
  void Rename(const std::string& path);

  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void Fail(const char* action) const;

  std::string path_;
  int descriptor_ = -1;
};

}  // namespace msc_vo
