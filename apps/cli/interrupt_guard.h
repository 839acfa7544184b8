// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

// While it lives, Ctrl-C (SIGINT), SIGTERM and a terminal that is closed (SIGHUP) raise a flag
// instead of ending the program; a second SIGINT or SIGTERM ends it as usual. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool IsInterrupted() const;
};

}  // namespace msc_vo
