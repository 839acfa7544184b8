// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace msc_vo {

/// A file that cannot be written.
class WriteError : public std::runtime_error {
 public:
  /// `cause`: errno; 0 if it is not known.
  WriteError(const std::string& path, int cause);

  /// Whether the disk or the quota is full, so that removing other files helps.
  bool LacksSpace() const { return lacks_space_; }

 private:
  bool lacks_space_;
};

/// Removes a file that can be done without, if `num_bytes` fit onto the disk without such files.
/// Returns whether it has removed one.
using MakeRoom = std::function<bool(std::uintmax_t num_bytes)>;

/// Whether `num_bytes` more fit onto the disk of a folder once `num_removed` bytes of it are
/// removed.
bool WouldFit(const std::string& folder, std::uintmax_t num_removed, std::uintmax_t num_bytes);

/// Calls `write` again as long as it throws a WriteError for lack of space and `make_room`, called
/// with `num_bytes`, returns true.
void WriteWithRoom(const std::function<void()>& write, std::uintmax_t num_bytes,
                   const MakeRoom& make_room);

}  // namespace msc_vo
