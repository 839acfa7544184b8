// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

/// Remembers in which process an object with threads was made: a process that is forked from it has
/// the memory of the object, but not its threads, so that it can neither use nor destroy it.
class ForkGuard {
 public:
  ForkGuard();
  /// Whether this process was forked since the guard was made.
  bool IsInherited() const;

 private:
  int num_forks_;
};

}  // namespace msc_vo
