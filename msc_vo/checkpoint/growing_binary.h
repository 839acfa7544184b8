// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace msc_vo {

/// A binary file that grows at its end and survives a crash of the system.
class GrowingBinary {
 public:
  /// Opens the file, or creates it. Throws std::runtime_error naming it.
  explicit GrowingBinary(const std::string& path);
  ~GrowingBinary();
  GrowingBinary(const GrowingBinary&) = delete;
  GrowingBinary& operator=(const GrowingBinary&) = delete;

  /// Writes bytes from position `offset` on, and ends the file behind them. What is before `offset`
  /// is unchanged if that fails. Both throw std::runtime_error naming the file.
  void Write(uint64_t offset, std::string_view bytes);
  /// Waits until all is on the disk, not only with the operating system.
  void Sync();

 private:
  [[noreturn]] void Fail(const char* action) const;

  std::string path_;
  int descriptor_ = -1;
};

/// Replaces a file by `parts`, one behind the other, as WriteFile() does, on the disk. Throws
/// std::runtime_error naming it; the file is then unchanged.
void ReplaceFileOnDisk(const std::string& path, const std::vector<std::string_view>& parts);

}  // namespace msc_vo
