// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <stdexcept>

namespace msc_vo {

/// Work that was ended by a signal and left no result. The command ends with kExitInterrupted.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// During its lifetime SIGINT (Ctrl-C), SIGTERM and SIGHUP (closed terminal) set a flag instead of
/// ending the program. A second SIGINT or SIGTERM ends the program. There must be only one guard at
/// a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool IsInterrupted() const;
};

}  // namespace msc_vo
