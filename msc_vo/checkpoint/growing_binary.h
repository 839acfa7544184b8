// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace msc_vo {

/// A binary file that grows at its end and survives a crash of the system: what Write() wrote is on
/// the disk, not only with the operating system.
class GrowingBinary {
 public:
  /// Opens the file, or creates it. Throws std::runtime_error naming it.
  explicit GrowingBinary(const std::string& path);
  ~GrowingBinary();
  GrowingBinary(const GrowingBinary&) = delete;
  GrowingBinary& operator=(const GrowingBinary&) = delete;

  /// Writes bytes from position `offset` on, and ends the file behind them. Throws
  /// std::runtime_error naming the file; what is before `offset` is then unchanged.
  void Write(uint64_t offset, std::string_view bytes);

 private:
  [[noreturn]] void Fail(const char* action) const;

  std::string path_;
  int descriptor_ = -1;
};

/// Replaces a file as WriteFile() does, on the disk. Throws std::runtime_error naming it; the file
/// is then unchanged.
void ReplaceFileOnDisk(const std::string& path, std::string_view bytes);

}  // namespace msc_vo
