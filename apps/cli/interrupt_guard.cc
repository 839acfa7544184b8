// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/interrupt_guard.h"

#include <csignal>

namespace msc_vo {

namespace {

volatile std::sig_atomic_t interrupted = 0;

extern "C" void RaiseFlag(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  std::signal(SIGINT, RaiseFlag);
  std::signal(SIGTERM, RaiseFlag);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::IsInterrupted() const { return interrupted != 0; }

}  // namespace msc_vo
